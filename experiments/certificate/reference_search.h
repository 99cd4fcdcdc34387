// Reference of a certificate: as many samples as its margin needs, within the given limits.
#pragma once

#include <string>

#include "experiments/certificate/certify.h"

namespace restlab::certificate {

// Returns the wanted relative standard error of the reference's mean.
double wantedReferenceError(const Options& options);

// Returns the samples per pixel with which `error` after `spp` falls to `wanted`: the error falls
// with the root of their number.
double sppForError(double error, double spp, double wanted);

// Describes the reference's error and samples, and the wanted ones. `timeS`: seconds for `spp`.
std::string searchText(double error, uint64_t spp, double timeS, const Options& options);

// Renders until the error is the wanted one, or up to options.maxReferenceSpp or half of the
// remaining time. Logs each step's wanted samples and time. Warns if the error stays above the
// wanted one. Throws Error.
Reference convergedReference(const Question& question, const std::string& label,
                             const Options& options);

// Estimates a certificate's cost: samples of the reference, the time of a run, and the number of
// runs. Renders some samples and frames and writes nothing.
std::string planOf(const Question& question, const Options& options);

}  // namespace restlab::certificate
