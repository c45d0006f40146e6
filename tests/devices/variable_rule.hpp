#pragma once
#include <gtest/gtest.h>

#include <span>
#include <string_view>

#include "devices/device.hpp"

namespace drycut::devices {

/// A variable as the manual has it: size, access, retentive (R) or zero (0), range, and the states that its
/// write needs, as the manual abbreviates them.
struct VariableRule {
  const char* name;
  char size;
  std::string_view access;
  char retention;
  double min;
  double max;
  const char* conditions = "";
};

inline constexpr double most = 2147483647;
inline constexpr double least = -2147483648;

/// The variables of `type` are those of the manual, in its order.
inline void expect_variables(const DeviceType& type, std::span<const VariableRule> rules) {
  ASSERT_EQ(rules.size(), type.variables.size());
  for (std::size_t i = 0; i < rules.size(); ++i) {
    const VariableRule& rule = rules[i];
    const DeviceVariable& variable = type.variables[i];
    EXPECT_EQ(variable.name, rule.name);
    EXPECT_EQ(static_cast<char>(variable.size), rule.size) << rule.name;
    EXPECT_EQ(variable.access == Access::read, rule.access == "R") << rule.name;
    EXPECT_EQ(variable.retention == Retention::retentive, rule.retention == 'R') << rule.name;
    EXPECT_EQ(variable.min, rule.min) << rule.name;
    EXPECT_EQ(variable.max, rule.max) << rule.name;
  }
}

}  // namespace drycut::devices
