#pragma once

namespace alea {

/// Version of the library, e.g. "0.1.0".
const char* version();

}  // namespace alea
