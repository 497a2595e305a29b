#pragma once

/// The whole library, in the order in which data flows.

#include "alea/core/cloud.hpp"
#include "alea/core/error.hpp"
#include "alea/core/noise_model.hpp"
#include "alea/core/parallel.hpp"
#include "alea/core/plane.hpp"
#include "alea/core/progress.hpp"
#include "alea/core/refusal.hpp"
#include "alea/core/result.hpp"
#include "alea/core/rigid_transform.hpp"
#include "alea/core/seed.hpp"
#include "alea/core/version.hpp"
