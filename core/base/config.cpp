#include "core/base/config.h"

#include <fmt/format.h>

#include <toml++/toml.h>
#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

#include "core/base/config_include.h"
#include "core/base/error.h"

namespace restlab {

namespace {

std::string kindOf(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return "an array";
    case toml::node_type::string:
      return "a string";
    case toml::node_type::integer:
      return "an integer";
    case toml::node_type::floating_point:
      return "a number";
    case toml::node_type::boolean:
      return "a boolean";
    default:
      return "a date or time";
  }
}

// Prefix that marks the "file" of an assigned value: the place that assigned it, without a line.
constexpr char kAssigned = '\x01';

std::string formatPlace(const toml::source_region& source, const std::string& file) {
  const std::string name = source.path ? *source.path : file;
  const bool isAssigned = !name.empty() && name.front() == kAssigned;
  return isAssigned ? name.substr(1) : tomlPlace(source, file);
}

std::string quotedList(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "'" : ", '") + name + "'";
  return text;
}

// Returns "unknown WHAT 'given', did you mean 'x'?", or the same with a list of the known names.
std::string unknownName(const std::string& what, const std::string& given,
                        const std::vector<std::string>& known) {
  const std::string near = nearestName(given, known);
  if (!near.empty()) return fmt::format("unknown {} '{}', did you mean '{}'?", what, given, near);
  return fmt::format("unknown {} '{}' (known: {})", what, given, quotedList(known));
}

std::string rangeText(double min, double max) {
  if (max >= std::numeric_limits<double>::max()) return fmt::format("at least {:g}", min);
  return fmt::format("in {:.10g}..{:.10g}", min, max);
}

std::vector<double> numbersOf(const toml::array& array, const std::string& key,
                              const std::string& file, double min, double max) {
  std::vector<double> values;
  for (const toml::node& element : array) {
    const auto value = element.is_number() ? element.value<double>() : std::nullopt;
    if (!value || !(*value >= min && *value <= max)) {
      failUsage(fmt::format("{}: '{}' must hold numbers {}", formatPlace(element.source(), file),
                            key, rangeText(min, max)));
    }
    values.push_back(*value);
  }
  return values;
}

// Converts a TOML node to the parameter's type; returns "" and sets `value`, or returns the fault.
std::string convertParameter(const ParameterInfo& info, const toml::node& node,
                             ParameterValue& value) {
  const bool bounded = info.minValue < info.maxValue;
  if (std::holds_alternative<bool>(info.defaultValue)) {
    const auto v = node.value_exact<bool>();
    if (!v) return fmt::format("'{}' must be true or false, not {}", info.name, kindOf(node));
    value = *v;
  } else if (std::holds_alternative<int64_t>(info.defaultValue)) {
    const auto v = node.value_exact<int64_t>();
    if (!v) return fmt::format("'{}' must be an integer, not {}", info.name, kindOf(node));
    if (bounded && !(double(*v) >= info.minValue && double(*v) <= info.maxValue)) {
      return fmt::format("'{}' must be {}, not {}", info.name,
                         rangeText(info.minValue, info.maxValue), *v);
    }
    value = *v;
  } else if (std::holds_alternative<double>(info.defaultValue)) {
    if (!node.is_number()) {
      return fmt::format("'{}' must be a number, not {}", info.name, kindOf(node));
    }
    const double v = *node.value<double>();
    if (!std::isfinite(v) || (bounded && !(v >= info.minValue && v <= info.maxValue))) {
      return fmt::format("'{}' must be {}, not {:g}", info.name,
                         bounded ? rangeText(info.minValue, info.maxValue) : "finite", v);
    }
    value = v;
  } else {
    const auto v = node.value_exact<std::string>();
    if (!v) return fmt::format("'{}' must be a string, not {}", info.name, kindOf(node));
    bool known = info.choices.empty();
    for (const std::string& choice : info.choices) known = known || choice == *v;
    if (!known) return unknownName(info.name, *v, info.choices);
    value = *v;
  }
  return "";
}

// Parses `text` as a TOML value, or else as a bare string. The document keeps the node alive.
toml::table parseValue(const std::string& text, const std::string& place) {
  if (text.find('\n') == std::string::npos && text.find('#') == std::string::npos) {
    try {
      return toml::parse("value = " + text, kAssigned + place);
    } catch (const toml::parse_error&) {
      // Not a TOML value: a bare word such as `unbiased` or a path.
    }
  }
  toml::table bare;
  bare.insert_or_assign("value", text);
  return bare;
}

}  // namespace

// One table and its state, shared by all ConfigTables that refer to it.
struct ConfigTable::Node {
  toml::table* table = nullptr;
  std::set<std::string> known;                // keys that were read
  std::map<std::string, std::string> places;  // places of assigned keys

  const toml::node* find(const std::string& key) {
    known.insert(key);
    return table->get(key);
  }
};

struct ConfigTable::Document {
  toml::table root;
  std::string file;
  std::map<const toml::table*, Node>
      nodes;  // the addresses stay valid: toml++ owns tables by pointer

  Node* nodeOf(toml::table& table) {
    Node& node = nodes[&table];
    node.table = &table;
    return &node;
  }
};

ConfigTable::ConfigTable(std::shared_ptr<Document> document, Node* node)
    : document_(std::move(document)), node_(node) {}

ConfigTable ConfigTable::parseText(const std::string& text, const std::string& name) {
  auto document = std::make_shared<Document>();
  document->file = name;
  document->root = parseTomlWithIncludes(text, name, "");
  Node* node = document->nodeOf(document->root);
  return ConfigTable(std::move(document), node);
}

ConfigTable ConfigTable::parseFile(const std::filesystem::path& file) {
  auto document = std::make_shared<Document>();
  document->file = file.string();
  document->root = parseTomlWithIncludes(readTomlText(file), document->file, file.parent_path());
  Node* node = document->nodeOf(document->root);
  return ConfigTable(std::move(document), node);
}

bool ConfigTable::has(const std::string& key) const { return node_->find(key) != nullptr; }

std::string ConfigTable::place(const std::string& key) const {
  const auto assigned = node_->places.find(key);
  if (assigned != node_->places.end()) return assigned->second;
  const toml::node* value = key.empty() ? nullptr : node_->table->get(key);
  return formatPlace(value ? value->source() : node_->table->source(), document_->file);
}

void ConfigTable::fail(const std::string& key, const std::string& message) const {
  failUsage(fmt::format("{}: {}", place(key), message));
}

std::string ConfigTable::getString(const std::string& key, const std::string& fallback) const {
  const toml::node* node = node_->find(key);
  if (!node) return fallback;
  if (!node->is_string()) {
    fail(key, fmt::format("'{}' must be a string, not {}", key, kindOf(*node)));
  }
  return *node->value<std::string>();
}

std::string ConfigTable::getChoice(const std::string& key, const std::string& fallback,
                                   const std::vector<std::string>& choices) const {
  const std::string value = getString(key, fallback);
  for (const std::string& choice : choices) {
    if (choice == value) return value;
  }
  fail(key, unknownName(key, value, choices));
}

bool ConfigTable::getBool(const std::string& key, bool fallback) const {
  const toml::node* node = node_->find(key);
  if (!node) return fallback;
  if (!node->is_boolean()) {
    fail(key, fmt::format("'{}' must be true or false, not {}", key, kindOf(*node)));
  }
  return *node->value<bool>();
}

int64_t ConfigTable::getInteger(const std::string& key, int64_t fallback, int64_t min,
                                int64_t max) const {
  const toml::node* node = node_->find(key);
  if (!node) return fallback;
  if (!node->is_integer()) {
    fail(key, fmt::format("'{}' must be an integer, not {}", key, kindOf(*node)));
  }
  const int64_t value = *node->value_exact<int64_t>();
  if (value < min || value > max) {
    fail(key, fmt::format("'{}' must be in {}..{}, not {}", key, min, max, value));
  }
  return value;
}

double ConfigTable::getNumber(const std::string& key, double fallback, double min,
                              double max) const {
  const toml::node* node = node_->find(key);
  if (!node) return fallback;
  if (!node->is_number()) {
    fail(key, fmt::format("'{}' must be a number, not {}", key, kindOf(*node)));
  }
  const double value = *node->value<double>();
  if (!(value >= min && value <= max)) {
    fail(key, fmt::format("'{}' must be {}, not {:g}", key, rangeText(min, max), value));
  }
  return value;
}

std::vector<std::string> ConfigTable::getStrings(const std::string& key,
                                                 const std::vector<std::string>& fallback) const {
  const toml::node* node = node_->find(key);
  if (!node) return fallback;
  if (node->is_string()) return {*node->value<std::string>()};
  const toml::array* array = node->as_array();
  if (!array) fail(key, fmt::format("'{}' must be an array of strings", key));
  std::vector<std::string> values;
  for (const toml::node& element : *array) {
    const auto value = element.value_exact<std::string>();
    if (!value) {
      failUsage(fmt::format("{}: '{}' must hold strings, not {}",
                            formatPlace(element.source(), document_->file), key, kindOf(element)));
    }
    values.push_back(*value);
  }
  return values;
}

std::vector<int64_t> ConfigTable::getIntegers(const std::string& key,
                                              const std::vector<int64_t>& fallback, int64_t min,
                                              int64_t max) const {
  const toml::node* node = node_->find(key);
  if (!node) return fallback;
  const toml::array* array = node->as_array();
  if (!array) fail(key, fmt::format("'{}' must be an array of integers", key));
  std::vector<int64_t> values;
  for (const toml::node& element : *array) {
    const auto value = element.value_exact<int64_t>();
    if (!value || *value < min || *value > max) {
      failUsage(fmt::format("{}: '{}' must hold integers in {}..{}",
                            formatPlace(element.source(), document_->file), key, min, max));
    }
    values.push_back(*value);
  }
  return values;
}

std::vector<std::string> ConfigTable::getTexts(const std::string& key) const {
  const toml::node* node = node_->find(key);
  if (!node) return {};
  std::vector<std::string> texts;
  const auto add = [&](const toml::node& value) {
    if (value.is_table()) fail(key, fmt::format("'{}' must hold values, not tables", key));
    std::ostringstream text;
    value.visit([&](const auto& typed) { text << typed; });
    texts.push_back(text.str());
  };
  if (const toml::array* array = node->as_array()) {
    for (const toml::node& element : *array) add(element);
  } else {
    add(*node);
  }
  return texts;
}

std::vector<std::string> ConfigTable::keys() const {
  std::vector<const toml::key*> found;
  for (const auto& [key, value] : *node_->table) found.push_back(&key);
  std::stable_sort(found.begin(), found.end(), [](const toml::key* a, const toml::key* b) {
    return a->source().begin < b->source().begin;
  });
  std::vector<std::string> names;
  for (const toml::key* key : found) names.emplace_back(key->str());
  return names;
}

std::vector<std::string> ConfigTable::known() const {
  return {node_->known.begin(), node_->known.end()};
}

std::string ConfigTable::text() const {
  std::ostringstream text;
  text << *node_->table << '\n';
  return text.str();
}

std::vector<double> ConfigTable::getNumbers(const std::string& key,
                                            const std::vector<double>& fallback, size_t count,
                                            double min, double max) const {
  const toml::node* node = node_->find(key);
  if (!node) return fallback;
  if (count == 1 && node->is_number()) return {getNumber(key, 0.0, min, max)};
  const toml::array* array = node->as_array();
  if (!array || array->size() != count) {
    fail(key, count == 1 ? fmt::format("'{}' must be a number", key)
                         : fmt::format("'{}' must be an array of {} numbers", key, count));
  }
  return numbersOf(*array, key, document_->file, min, max);
}

std::vector<double> ConfigTable::getList(const std::string& key, double min, double max) const {
  const toml::node* node = node_->find(key);
  if (!node) return {};
  if (!node->is_array()) fail(key, fmt::format("'{}' must be an array of numbers", key));
  return numbersOf(*node->as_array(), key, document_->file, min, max);
}

std::vector<std::vector<double>> ConfigTable::getRows(const std::string& key, size_t width,
                                                      double min, double max) const {
  const toml::node* node = node_->find(key);
  if (!node) return {};
  if (!node->is_array())
    fail(key, fmt::format("'{}' must be an array of arrays of {} numbers", key, width));
  std::vector<std::vector<double>> rows;
  for (const toml::node& row : *node->as_array()) {
    if (!row.is_array() || row.as_array()->size() != width)
      failUsage(fmt::format("{}: '{}' must hold arrays of {} numbers",
                            formatPlace(row.source(), document_->file), key, width));
    rows.push_back(numbersOf(*row.as_array(), key, document_->file, min, max));
  }
  return rows;
}

ConfigTable ConfigTable::getTable(const std::string& key) const {
  const toml::node* found = node_->find(key);
  if (!found) {
    node_->table->insert_or_assign(key, toml::table{});
  } else if (!found->is_table()) {
    fail(key, fmt::format("'{}' must be a table, not {}", key, kindOf(*found)));
  }
  return ConfigTable(document_, document_->nodeOf(*node_->table->get(key)->as_table()));
}

std::vector<ConfigTable> ConfigTable::getTables(const std::string& key) const {
  std::vector<ConfigTable> tables;
  if (!node_->find(key)) return tables;
  toml::array* array = node_->table->get(key)->as_array();
  if (!array) fail(key, fmt::format("'{0}' must be written as [[{0}]]", key));
  for (toml::node& element : *array) {
    if (!element.is_table()) fail(key, fmt::format("'{0}' must be written as [[{0}]]", key));
    tables.push_back(ConfigTable(document_, document_->nodeOf(*element.as_table())));
  }
  return tables;
}

std::optional<ParameterValue> ConfigTable::getParameter(const ParameterInfo& info) const {
  const toml::node* node = node_->find(info.name);
  if (!node) return std::nullopt;
  ParameterValue value;
  const std::string wrong = convertParameter(info, *node, value);
  if (!wrong.empty()) fail(info.name, wrong);
  return value;
}

void ConfigTable::assign(const std::string& key, const std::string& valueText,
                         const std::string& place) {
  toml::table parsed = parseValue(valueText, place);
  toml::node* value = parsed.get("value");
  value->visit([&](auto& typed) { node_->table->insert_or_assign(key, std::move(typed)); });
  node_->places[key] = place;
}

void ConfigTable::remove(const std::string& key) {
  node_->table->erase(key);
  node_->places.erase(key);
}

void ConfigTable::finish() const {
  const toml::key* first = nullptr;
  for (const auto& [key, value] : *node_->table) {
    if (node_->known.count(std::string(key.str()))) continue;
    if (!first || key.source().begin < first->source().begin) first = &key;
  }
  if (!first) return;
  const std::string key(first->str());
  const auto assigned = node_->places.find(key);
  const std::string where = assigned != node_->places.end()
                                ? assigned->second
                                : formatPlace(first->source(), document_->file);
  const std::vector<std::string> known(node_->known.begin(), node_->known.end());
  failUsage(fmt::format("{}: {}", where, unknownName("key", key, known)));
}

ParameterValue parseParameter(const ParameterInfo& info, const std::string& text,
                              const std::string& place) {
  toml::table parsed = parseValue(text, place);
  ParameterValue value;
  const std::string wrong = convertParameter(info, *parsed.get("value"), value);
  if (!wrong.empty()) failUsage(fmt::format("{}: {}", place, wrong));
  return value;
}

std::pair<std::string, std::string> splitAssignment(const std::string& assignment,
                                                    const std::string& option) {
  const size_t equals = assignment.find('=');
  if (equals == std::string::npos || equals == 0) {
    failUsage(fmt::format("{} {}: must be KEY=VALUE", option, assignment));
  }
  return {assignment.substr(0, equals), assignment.substr(equals + 1)};
}

}  // namespace restlab
