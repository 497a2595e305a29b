#pragma once

#include <string>

#include "alea/pipeline/die_stages.hpp"
#include "alea/report/page.hpp"

namespace alea {

/// The result page of a registration by the die: verdict, numbers and a picture of every stage that
/// was reached, so also of a refusal. The names say which files the scans came from.
Page die_page(const StagedDieRegistration& staged, const std::string& master_name,
              const std::string& slave_name);

}  // namespace alea
