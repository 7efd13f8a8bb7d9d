// Options as Python passes them, by name.
#pragma once

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <array>
#include <string>
#include <string_view>
#include <utility>

#include "native/errors.h"

namespace medial_vk::python {

/// A word, and the value that it stands for.
template <class T>
using Choice = std::pair<std::string_view, T>;

/// Reads a dictionary of options. Each of its entries must be read: an unread one is a defect of this package.
class Options {
 public:
  explicit Options(pybind11::dict values) : values_(std::move(values)) {}

  /// Sets `field` to the option, which must be there. Error: kUsage, which names the option, if its type or range does
  /// not fit.
  template <class T>
  void read(const char* name, T& field) {
    const pybind11::object value = take(name);
    try {
      field = value.cast<T>();
    } catch (const pybind11::cast_error&) {
      fail(name, value);
    }
  }

  /// The same for a text among several, each of which stands for a value.
  template <class T, std::size_t n>
  void read(const char* name, T& field, const std::array<Choice<T>, n>& choices) {
    const std::string text = text_of(name);
    std::string known;
    for (const auto& [word, value] : choices) {
      if (word == text) {
        field = value;
        return;
      }
      known.append(known.empty() ? "" : ", ").append(word);
    }
    fail_choice(name, text, known);
  }

  /// Throws if an option was not read.
  void finish() const;

 private:
  pybind11::object take(const char* name);
  std::string text_of(const char* name);
  [[noreturn]] static void fail(const char* name, const pybind11::object& value);
  [[noreturn]] static void fail_choice(const char* name, const std::string& text, const std::string& known);

  pybind11::dict values_;
};

}  // namespace medial_vk::python
