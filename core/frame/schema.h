// Parameters of a part, written once: a struct whose members hold the defaults, and a schema that
// gives each member its name, range, meaning and source.
#pragma once

#include <algorithm>
#include <functional>
#include <initializer_list>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "core/frame/part.h"

namespace restlab {

// Inclusive bounds of a number.
struct Range {
  double lo = 0.0, hi = 0.0;
};
// Values of a string.
using Choices = std::vector<std::string>;

// One member of `Settings` as a parameter. Members are bool, uint32_t, double or std::string.
template <class Settings>
class Parameter {
 public:
  template <class T>
  Parameter(T Settings::*member, const char* name, Range range, const char* help,
            const char* source)
      : Parameter(Base{}, member, name, help, source) {
    info_.minValue = range.lo;
    info_.maxValue = range.hi;
  }
  Parameter(std::string Settings::*member, const char* name, Choices choices, const char* help,
            const char* source)
      : Parameter(Base{}, member, name, help, source) {
    info_.choices = std::move(choices);
  }
  // A member that holds the index of the choice.
  Parameter(uint32_t Settings::*member, const char* name, Choices choices, const char* help,
            const char* source)
      : set_([member, choices](Settings& settings, const ParameterValue& value) {
          const auto found =
              std::find(choices.begin(), choices.end(), std::get<std::string>(value));
          settings.*member = uint32_t(found - choices.begin());
        }),
        get_([member, choices](const Settings& settings) -> ParameterValue {
          return choices.at(settings.*member);
        }) {
    describe(name, help, source);
    info_.choices = std::move(choices);
  }
  Parameter(bool Settings::*member, const char* name, const char* help, const char* source)
      : Parameter(Base{}, member, name, help, source) {}

  // A change of the value begins a new history: the old one holds light of the old value.
  Parameter beginsHistory() const {
    Parameter changed = *this;
    changed.info_.beginsHistory = true;
    return changed;
  }
  // ParameterInfo::sameMean.
  Parameter sameMean() const {
    Parameter changed = *this;
    changed.info_.sameMean = true;
    return changed;
  }
  // ParameterInfo::needs.
  Parameter needs(const char* input) const {
    Parameter changed = *this;
    changed.info_.needs = input;
    return changed;
  }

  ParameterInfo info(const Settings& defaults) const {
    ParameterInfo info = info_;
    info.defaultValue = get_(defaults);
    return info;
  }
  const std::string& name() const { return info_.name; }
  void read(Settings& settings, const ParameterValue& value) const { set_(settings, value); }

 private:
  struct Base {};  // tells the constructor below from the others
  template <class T>
  Parameter(Base, T Settings::*member, const char* name, const char* help, const char* source)
      : set_([member](Settings& settings, const ParameterValue& value) {
          settings.*member = static_cast<T>(std::get<Stored<T>>(value));
        }),
        get_([member](const Settings& settings) -> ParameterValue {
          return static_cast<Stored<T>>(settings.*member);
        }) {
    describe(name, help, source);
  }
  void describe(const char* name, const char* help, const char* source) {
    info_.name = name;
    info_.help = help;
    info_.source = source;
  }

  template <class T>
  using Stored = std::conditional_t<std::is_same_v<T, uint32_t>, int64_t, T>;

  ParameterInfo info_;
  std::function<void(Settings&, const ParameterValue&)> set_;
  std::function<ParameterValue(const Settings&)> get_;
};

template <class Settings>
class Schema {
 public:
  Schema(std::initializer_list<Parameter<Settings>> parameters) : parameters_(parameters) {}

  // Descriptions, with the defaults that `defaults` has.
  std::vector<ParameterInfo> infos(const Settings& defaults = {}) const {
    std::vector<ParameterInfo> all;
    for (const Parameter<Settings>& parameter : parameters_)
      all.push_back(parameter.info(defaults));
    return all;
  }
  // Reads resolved parameters. A parameter that the method lacks keeps its default.
  Settings read(const ParameterMap& resolved) const {
    Settings settings;
    assign(settings, resolved);
    return settings;
  }
  // Sets the members that `values` names.
  void assign(Settings& settings, const ParameterMap& values) const {
    for (const Parameter<Settings>& parameter : parameters_) {
      const auto found = values.find(parameter.name());
      if (found != values.end()) parameter.read(settings, found->second);
    }
  }

 private:
  std::vector<Parameter<Settings>> parameters_;
};

// Appends the parameters of another schema.
inline void append(std::vector<ParameterInfo>& to, std::vector<ParameterInfo> more) {
  for (ParameterInfo& info : more) to.push_back(std::move(info));
}

}  // namespace restlab
