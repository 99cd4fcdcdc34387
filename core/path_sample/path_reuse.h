// Parameters of methods that resample paths: the passes of core/reuse, over path samples.
#ifndef RL_PATH_REUSE_H
#define RL_PATH_REUSE_H

#ifdef __cplusplus
#include "core/dialect/order.h"
#endif
#include "core/path_sample/path_in_view.h"
#include "core/path_sample/path_record.h"
#include "core/path_sample/path_sample.h"
#include "core/path_sample/path_shift.h"
#include "core/reuse/reuse.h"

// Types of the sample that the passes of core/reuse move and shift.
#define RL_RESERVOIR PathReservoir
#define RL_SHIFT PathShift

RL_NAMESPACE_BEGIN

struct PathReuseParams {
  ReuseParams reuse;
  PathParams path;
  PairParams pairs;
  EntryParams entries;
  RadianceParams cells;
  ChangeParams changes;
};

RL_NAMESPACE_END

#define RL_KERNEL_PARAMS PathReuseParams

#endif
