#include "alea/io/toml_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>
#include <sstream>
#define TOML_HEADER_ONLY 1
#include <toml++/toml.h>

#include "alea/core/error.hpp"

namespace alea {

struct TomlTable::State {
  std::shared_ptr<const toml::table> root;  // keeps `table` alive
  const toml::table* table = nullptr;
  std::string file;
  std::string name;  // "die" of [[die]], empty for the whole file
  std::uint32_t line = 1;
  mutable std::set<std::string> asked;

  const toml::node* find(const std::string& key) const {
    asked.insert(key);
    return table->get(key);
  }
};

namespace {

std::string as_text(const toml::node& node) {
  std::ostringstream out;
  if (node.is_table()) return "a table";
  if (node.is_array() && node.as_array()->is_array_of_tables()) return "tables";
  node.visit([&out](const auto& value) { out << value; });
  std::string text = out.str();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

const char* expectation_of(Allowed allowed) {
  switch (allowed) {
    case Allowed::positive:
      return "a positive number";
    case Allowed::not_negative:
      return "a number that is not negative";
    case Allowed::any:
      break;
  }
  return "a finite number";
}

bool allows(Allowed allowed, double value) {
  if (!std::isfinite(value)) return false;
  return allowed == Allowed::any || (allowed == Allowed::positive ? value > 0 : value >= 0);
}

/// The numbers of an array of `count`, or nothing.
std::optional<std::vector<double>> numbers_of(const toml::node& node, std::size_t count) {
  const toml::array* array = node.as_array();
  if (array == nullptr || array->size() != count) return std::nullopt;
  std::vector<double> numbers;
  for (const toml::node& element : *array) {
    const auto number = element.value<double>();
    if (!element.is_number() || !number || !std::isfinite(*number)) return std::nullopt;
    numbers.push_back(*number);
  }
  return numbers;
}

}  // namespace

TomlTable::TomlTable(std::unique_ptr<State> state) : state_(std::move(state)) {}
TomlTable::~TomlTable() = default;
TomlTable::TomlTable(TomlTable&&) noexcept = default;
TomlTable& TomlTable::operator=(TomlTable&&) noexcept = default;

TomlTable TomlTable::read(const std::filesystem::path& file) {
  const std::string name = file.string();
  std::ifstream in(file, std::ios::binary);
  std::stringstream text;
  if (std::filesystem::is_directory(file) || !in || !(text << in.rdbuf()))
    throw input_error(name + ": cannot be read as a TOML file; give an existing, non-empty file");
  auto state = std::make_unique<State>();
  try {
    state->root = std::make_shared<const toml::table>(toml::parse(text.str(), name));
  } catch (const toml::parse_error& error) {
    throw input_error(
        fmt::format("{}:{}: not TOML: {}", name, error.source().begin.line, error.description()));
  }
  state->table = state->root.get();
  state->file = name;
  return TomlTable(std::move(state));
}

bool TomlTable::has(const std::string& key) const {
  return state_->find(key) != nullptr;
}

double TomlTable::number(const std::string& key, double missing, Allowed allowed) const {
  const toml::node* node = state_->find(key);
  if (node == nullptr) return missing;
  const auto value = node->value<double>();
  if (!node->is_number() || !value || !allows(allowed, *value)) fail(key, expectation_of(allowed));
  return *value;
}

std::int64_t TomlTable::integer(const std::string& key, std::int64_t missing, std::int64_t low,
                                std::int64_t high) const {
  const toml::node* node = state_->find(key);
  if (node == nullptr) return missing;
  const auto value = node->value<std::int64_t>();
  if (!node->is_integer() || !value || *value < low || *value > high)
    fail(key, fmt::format("a whole number from {} to {}", low, high));
  return *value;
}

bool TomlTable::flag(const std::string& key, bool missing) const {
  const toml::node* node = state_->find(key);
  if (node == nullptr) return missing;
  if (!node->is_boolean()) fail(key, "true or false");
  return *node->value<bool>();
}

std::string TomlTable::text(const std::string& key, const std::string& missing) const {
  const toml::node* node = state_->find(key);
  if (node == nullptr) return missing;
  if (!node->is_string()) fail(key, "a text in quotes");
  return *node->value<std::string>();
}

std::size_t TomlTable::choice(const std::string& key, std::size_t missing,
                              const std::vector<std::string>& words) const {
  const toml::node* node = state_->find(key);
  if (node == nullptr) return missing;
  const std::string word = node->is_string() ? *node->value<std::string>() : "";
  const auto found = std::find(words.begin(), words.end(), word);
  if (found == words.end()) fail(key, fmt::format("one of {}", fmt::join(words, ", ")));
  return static_cast<std::size_t>(found - words.begin());
}

std::vector<std::string> TomlTable::texts(const std::string& key) const {
  std::vector<std::string> out;
  const toml::node* node = state_->find(key);
  if (node == nullptr) return out;
  if (!node->is_array()) fail(key, "texts in quotes [\"...\", \"...\"]");
  for (const toml::node& element : *node->as_array()) {
    if (!element.is_string()) fail(key, "texts in quotes [\"...\", \"...\"]");
    out.push_back(*element.value<std::string>());
  }
  return out;
}

std::vector<double> TomlTable::numbers(const std::string& key) const {
  const toml::node* node = state_->find(key);
  if (node == nullptr) return {};
  const auto numbers =
      node->is_array() ? numbers_of(*node, node->as_array()->size()) : std::nullopt;
  if (!numbers) fail(key, "finite numbers [a, b, ...]");
  return *numbers;
}

Eigen::Vector3d TomlTable::vector3(const std::string& key, const Eigen::Vector3d& missing) const {
  const toml::node* node = state_->find(key);
  if (node == nullptr) return missing;
  const auto numbers = numbers_of(*node, 3);
  if (!numbers) fail(key, "three finite numbers [x, y, z]");
  return {(*numbers)[0], (*numbers)[1], (*numbers)[2]};
}

Eigen::Vector3d TomlTable::vector3(const std::string& key) const {
  require(key);
  return vector3(key, Eigen::Vector3d::Zero());
}

std::vector<Eigen::Vector3d> TomlTable::vectors(const std::string& key) const {
  std::vector<Eigen::Vector3d> out;
  const toml::node* node = state_->find(key);
  if (node == nullptr) return out;
  if (!node->is_array()) fail(key, "a list of three finite numbers each [[x, y, z], ...]");
  for (const toml::node& element : *node->as_array()) {
    const auto numbers = numbers_of(element, 3);
    if (!numbers) fail(key, "a list of three finite numbers each [[x, y, z], ...]");
    out.emplace_back((*numbers)[0], (*numbers)[1], (*numbers)[2]);
  }
  return out;
}

Eigen::Vector2d TomlTable::interval(const std::string& key, const Eigen::Vector2d& missing) const {
  const toml::node* node = state_->find(key);
  if (node == nullptr) return missing;
  const auto numbers = numbers_of(*node, 2);
  if (!numbers || (*numbers)[0] > (*numbers)[1])
    fail(key, "two finite numbers [from, to] in ascending order");
  return {(*numbers)[0], (*numbers)[1]};
}

std::optional<TomlTable> TomlTable::table(const std::string& key) const {
  const toml::node* node = state_->find(key);
  if (node == nullptr) return std::nullopt;
  if (!node->is_table()) fail(key, fmt::format("a table [{}]", key));
  auto state = std::make_unique<State>();
  state->root = state_->root;
  state->table = node->as_table();
  state->file = state_->file;
  state->name = state_->name.empty() ? key : state_->name + "." + key;
  state->line = node->source().begin.line;
  return TomlTable(std::move(state));
}

std::vector<TomlTable> TomlTable::tables(const std::string& key) const {
  const toml::node* node = state_->find(key);
  std::vector<TomlTable> out;
  if (node == nullptr) return out;
  const toml::array* array = node->as_array();
  if (array == nullptr || !array->is_array_of_tables())
    fail(key, fmt::format("tables [[{}]]", key));
  for (const toml::node& element : *array) {
    auto state = std::make_unique<State>();
    state->root = state_->root;
    state->table = element.as_table();
    state->file = state_->file;
    state->name = state_->name.empty() ? key : state_->name + "." + key;
    state->line = element.source().begin.line;
    out.push_back(TomlTable(std::move(state)));
  }
  return out;
}

void TomlTable::require(const std::string& key) const {
  if (!has(key)) fail("", fmt::format("the key '{}', which is missing", key));
}

void TomlTable::finish() const {
  for (const auto& [key, node] : *state_->table) {
    const std::string name(key.str());
    if (!state_->asked.contains(name))
      throw input_error(fmt::format("{}:{}: unknown key '{}'; known here: {}", state_->file,
                                    key.source().begin.line, name, fmt::join(state_->asked, ", ")));
  }
}

void TomlTable::fail(const std::string& key, const std::string& expectation) const {
  const toml::node* node = key.empty() ? nullptr : state_->table->get(key);
  const std::string prefix = state_->name.empty() ? "" : state_->name + ".";
  if (node == nullptr)
    throw input_error(fmt::format(
        "{}:{}: {}: expected {}", state_->file, state_->line,
        key.empty() ? (state_->name.empty() ? "file" : state_->name) : prefix + key, expectation));
  throw input_error(fmt::format("{}:{}: {}{} = {}; expected {}", state_->file,
                                node->source().begin.line, prefix, key, as_text(*node),
                                expectation));
}

}  // namespace alea
