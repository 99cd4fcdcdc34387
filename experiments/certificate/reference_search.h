// The reference of a certificate: as many samples as its margin asks for, within the bounds that
// are set.
#pragma once

#include <string>

#include "experiments/certificate/certify.h"

namespace restlab::certificate {

// The relative standard error of the reference's mean that a certificate wants, of 1.
double wantedReferenceError(const Options& options);

// Samples per pixel with which an error of `error` after `spp` falls to `wanted`: it falls by the
// root of their number.
double sppForError(double error, double spp, double wanted);

// The reference's error and samples that there are, and those that are wanted, in words. `timeS`:
// seconds that those samples took.
std::string searchText(double error, uint64_t spp, double timeS, const Options& options);

// Renders until the error is the wanted one, or options.maxReferenceSpp or half of the time that is
// left is spent. Says first what is wanted and what that will take. A reference that stays above is
// a warning. Throws Error.
Reference convergedReference(const Question& question, const std::string& label,
                             const Options& options);

// Estimates a certificate's cost, in lines: the reference and its error, the time of a run, and how
// many runs there may be. Renders some samples and frames and writes nothing.
std::string planOf(const Question& question, const Options& options);

}  // namespace restlab::certificate
