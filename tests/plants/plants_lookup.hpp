#pragma once
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "plants/plant.hpp"
#include "plants/world.hpp"

namespace drycut::plants {

// What a plant offers, by name; a name that is not offered fails the test.

template <class Plug>
Plug& plug(Plant& plant, const std::string& name) {
  for (const Port& port : plant.ports())
    if (port.name == name) return *std::get<Plug*>(port.plug);
  ADD_FAILURE() << "no port " << name;
  throw std::out_of_range(name);
}

inline double channel(Plant& plant, const std::string& name) {
  for (const Channel& c : plant.channels())
    if (c.name == name) return c.read();
  ADD_FAILURE() << "no channel " << name;
  throw std::out_of_range(name);
}

inline void set(Plant& plant, const std::string& name, double value) {
  for (const Setting& s : plant.settings())
    if (s.name == name) return s.write(value);
  ADD_FAILURE() << "no setting " << name;
}

inline void fault(std::vector<Fault> faults, const std::string& component, const std::string& name,
                  double value) {
  for (const Fault& f : faults)
    if (f.component == component && f.name == name) return f.act(value);
  ADD_FAILURE() << "no fault " << component << " " << name;
}

inline double value(const Event& event, const std::string& name) {
  for (const Event::Value& v : event.values)
    if (v.name == name) return v.number;
  ADD_FAILURE() << "no value " << name;
  return 0;
}

}  // namespace drycut::plants
