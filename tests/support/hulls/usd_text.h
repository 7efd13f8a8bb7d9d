// A reader of USD text for tests, strict about the grammar of what a file of hulls may hold: metadata, prims with
// schemas, typed properties, numbers, strings, tuples and lists.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace medial_vk::test {

/// A number, a string, a tuple or a list.
struct UsdValue {
  enum class Type { kNumber, kString, kTuple, kList };
  Type type = Type::kNumber;
  double number = 0;
  std::string text;
  std::vector<UsdValue> items;

  std::vector<double> numbers() const;
};

struct UsdProperty {
  std::string type;  ///< "double", "float3[]".
  bool is_uniform = false;
  UsdValue value;
};

struct UsdPrim {
  std::string type, name;
  std::map<std::string, UsdValue> metadata;
  std::map<std::string, UsdProperty> properties;
  std::vector<UsdPrim> children;

  const UsdValue& at(const std::string& property) const { return properties.at(property).value; }
  double number(const std::string& property) const { return at(property).number; }
};

struct UsdLayer {
  std::map<std::string, UsdValue> metadata;
  std::vector<UsdPrim> prims;
};

/// Throws std::runtime_error with the place of the first fault.
UsdLayer parse_usd(const std::string& text);

}  // namespace medial_vk::test
