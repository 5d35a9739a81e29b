#include "energy/provenance.h"

namespace encore::energy {

std::string_view to_string(Origin origin) {
  switch (origin) {
    case Origin::measured:
      return "measured";
    case Origin::modelled:
      return "modelled";
    case Origin::simulated:
      return "simulated";
    case Origin::unavailable:
      return "unavailable";
  }
  return "unavailable";
}

std::optional<Origin> parse_origin(std::string_view word) {
  for (const Origin origin :
       {Origin::measured, Origin::modelled, Origin::simulated, Origin::unavailable}) {
    if (word == to_string(origin)) return origin;
  }
  return std::nullopt;
}

}  // namespace encore::energy
