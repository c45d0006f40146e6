#pragma once
#include "plants/web.hpp"
#include "tests/plants/plants_lookup.hpp"

namespace drycut::plants {

inline WebDefinition web_of(const WebData& data) {
  WebDefinition definition;
  definition.data = data;
  return definition;
}

/// A web alone, whose pieces are separated by hand.
struct WebLine : Machine {
  Web& web;
  explicit WebLine(const WebData& data = {}) : Machine(web_of(data)), web(static_cast<Web&>(*plant)) {}
};

}  // namespace drycut::plants
