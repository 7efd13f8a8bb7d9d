// Options of a command line on a CLI11 application, for every command of the program. Only for files that parse
// options: CLI11 is large.
#pragma once

#include <CLI/CLI.hpp>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "cli/options/parse_number.h"
#include "cli/options/parse_picture.h"

namespace medial_vk::cli {

inline Error usage_error(std::string message) { return {ErrorCode::kUsage, std::move(message)}; }

/// Declares options on a CLI11 application. Values arrive as text and are parsed here, because CLI11 would accept "1e3"
/// or "12abc" for some numbers, and its messages do not name the range.
class Declarations {
 public:
  explicit Declarations(CLI::App& app) : app_(app) {}

  void text(const char* name, const char* value, std::string& target) {
    app_.add_option(name, target)->type_name(value);
  }

  /// Any number of values.
  void texts(const char* name, const char* values, std::vector<std::string>& targets) {
    app_.add_option(name, targets)->type_name(values);
  }

  /// Any number of values, or none: an empty one then.
  void texts_or_none(const char* name, const char* values, std::vector<std::string>& targets) {
    app_.add_option(name, targets)->type_name(values)->expected(0, CLI::detail::expected_max_vector_size);
  }

  void flag(const char* name, bool& target) { app_.add_flag(name, target); }

  template <class T>
  void action(const char* name, T value, T& target) {
    app_.add_flag_callback(name, [value, &target] { target = value; });
  }

  void real(const char* name, const RealRange& range, const char* unit, double& target) {
    parsed(
        name, [=](const std::string& text) { return parse_real(text, range, unit); }, target);
  }

  /// `unit`: " (units of the mesh)".
  void length(const char* name, double greatest, const char* unit, std::optional<Length>& target) {
    parsed(
        name, [=](const std::string& text) { return parse_length(text, greatest, unit); }, target);
  }

  template <class T>
  void whole(const char* name, std::uint64_t least, std::uint64_t greatest, const char* unit, T& target) {
    parsed(
        name, [=](const std::string& text) { return parse_whole(text, least, greatest, unit); }, target);
  }

  /// A row of a table, from 1.
  void row(const char* name, std::size_t& target) { whole(name, 1, 1'000'000'000, "", target); }
  void memory(const char* name, std::uint64_t& target) { parsed(name, parse_memory, target); }
  void view(const char* name, ViewChoice& target) { parsed(name, parse_view, target); }
  void up(const char* name, UpAxis& target) { parsed(name, parse_up, target); }
  void size(const char* name, std::array<std::uint32_t, 2>& target) { parsed(name, parse_size, target); }

  /// `Target` is T or std::optional<T>.
  template <class T, class Target>
  void choice(const char* name, std::vector<std::pair<std::string, T>> choices, Target& target) {
    const auto parse = [choices](const std::string& text) -> Result<T> {
      std::string known;
      for (const auto& [word, value] : choices) {
        if (word == text) return value;
        known += (known.empty() ? "" : " or ") + word;
      }
      return usage_error(fmt::format("'{}' is unknown; use {}", text, known));
    };
    parsed(name, parse, target);
  }

 private:
  template <class Parse, class T>
  void parsed(const char* name, Parse parse, T& target) {
    const auto set = [name, parse, &target](const std::string& text) {
      const auto value = parse(text);
      if (!value) throw CLI::ValidationError(name, value.error().message);
      target = static_cast<T>(value.value());
    };
    app_.add_option_function<std::string>(name, set)->type_name("value");
  }

  CLI::App& app_;
};

/// An application that parses several command lines in sequence.
class ReusableApp : public CLI::App {
 public:
  /// CLI11 resets itself between lines, but not after a line that ended with an error. It never resets the order of the
  /// options, a list that grows from line to line.
  void forget() {
    clear();
    parse_order_.clear();
  }
};

/// A picture ends in .png, a page in .html. Error: kUsage.
Status check_view_files(const std::string& picture, const std::string& html);

/// Combines --view with the --up in `view`. Error: kUsage, if one is given and nothing is drawn.
Status take_view(const ViewChoice& choice, bool is_drawn, PictureView& view);

/// Only pictures and pages show a row. Error: kUsage.
Status check_row(std::size_t row, const std::string& picture, const std::string& html);

/// Parses `arguments` into the options declared on `app`, which must allow extras: they are reported here, with a
/// suggestion. `one_only` follows the name of a second input ("one mesh at a time"). Errors: kUsage.
Status parse_arguments(CLI::App& app, std::vector<std::string> arguments, const char* one_only);

}  // namespace medial_vk::cli
