// The rows of wrong_inputs.txt; its first lines say how one is written.
#pragma once

#include <algorithm>
#include <fstream>
#include <map>
#include <regex>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/file/scene/scene_file.h"
#include "core/algorithm/algorithm.h"

namespace hapticwall::command::test {

struct GivenFile {
  std::string name;
  std::string text;
};

struct WrongInput {
  std::string section;
  std::string name;
  int line = 0;  // of its name
  std::vector<GivenFile> files;
  std::vector<std::string> arguments;
  int status = 0;
  std::string sentence;
};

class WrongInputReader {
 public:
  explicit WrongInputReader(const std::string& path) : path_(path) {
    for (const file::BuiltinScene& scene : file::builtin_scenes()) {
      texts_[scene.name] = std::string(scene.toml_text);
    }
  }

  [[nodiscard]] std::vector<WrongInput> read() {
    std::ifstream in(path_);
    for (std::string line; std::getline(in, line); ++line_) take(line);
    finish_row();
    if (rows_.empty()) throw std::runtime_error(path_ + ": no rows");
    return std::move(rows_);
  }

 private:
  [[noreturn]] void fail(std::string_view what) const {
    throw std::runtime_error(path_ + ":" + std::to_string(line_) + ": " + std::string(what));
  }

  void take(const std::string& line) {
    if (line.empty() || line.starts_with('#')) return;
    const bool begins_section = line.starts_with("== ");
    if (!begins_section && !line.starts_with("-- ")) {
      lines_.push_back(line);
      return;
    }
    finish_row();
    (begins_section ? section_ : name_) = line.substr(3);
    line_of_name_ = line_;
  }

  // Lines with lists of choices are as many rows as a list has choices.
  void finish_row() {
    if (lines_.empty()) return;
    std::vector<std::string> choices{""};
    for (auto line = lines_.rbegin(); line != lines_.rend(); ++line) {
      if (std::smatch list; std::regex_search(*line, list, list_)) choices = split(list.str(1));
    }
    for (std::size_t i = 0; i < choices.size(); ++i) {
      if (!name_.empty()) rows_.push_back({section_, name_, line_of_name_, {}, {}, 0, ""});
      for (const std::string& line : lines_) take_chosen(chosen(line, i, choices[i]));
    }
    lines_.clear();
  }

  [[nodiscard]] static std::vector<std::string> split(std::string_view list) {
    std::vector<std::string> choices;
    for (std::size_t bar = list.find('|'); bar != std::string_view::npos; bar = list.find('|')) {
      choices.emplace_back(list.substr(0, bar));
      list.remove_prefix(bar + 1);
    }
    choices.emplace_back(list);
    return choices;
  }

  // `same` stands for (=).
  [[nodiscard]] std::string chosen(std::string line, std::size_t index,
                                   const std::string& same) const {
    constexpr std::string_view kSame = "(=)";
    for (std::smatch list; std::regex_search(line, list, list_);) {
      const std::vector<std::string> choices = split(list.str(1));
      if (index >= choices.size()) fail("a list has fewer choices than the first one");
      line = list.prefix().str() + choices[index] + list.suffix().str();
    }
    for (std::size_t at = line.find(kSame); at != std::string::npos; at = line.find(kSame)) {
      line.replace(at, kSame.size(), same);
    }
    return line;
  }

  void take_chosen(const std::string& line) {
    if (line.starts_with("$ ")) {
      rows_.back().arguments = words(line.substr(2));
    } else if (line[0] >= '0' && line[0] <= '9' && line.substr(1, 2) == ": ") {
      rows_.back().status = line[0] - '0';
      rows_.back().sentence = with_algorithms(line.substr(3));
    } else {
      take_text(line);
    }
  }

  [[nodiscard]] static std::string with_algorithms(std::string sentence) {
    constexpr std::string_view kSign = "{algorithms}";
    const std::size_t at = sentence.find(kSign);
    if (at == std::string::npos) return sentence;
    std::string names;
    for (const AlgorithmDescription& algorithm : algorithms()) {
      names += (names.empty() ? "" : ", ") + std::string(algorithm.name);
    }
    return sentence.replace(at, kSign.size(), names);
  }

  // NAME = TEXT, or NAME <- OTHER: OLD => NEW. Before the first row it is a text for the rows, else
  // a file of the row.
  void take_text(const std::string& line) {
    const std::size_t equals = line.ends_with(" =") ? line.size() - 2 : line.find(" = ");
    const std::size_t arrow = line.find(" <- ");
    constexpr std::size_t kSign = 3;
    GivenFile given{line.substr(0, std::min(equals, arrow)), ""};
    if (arrow != std::string::npos && arrow < equals) {
      given.text = changed(line.substr(arrow + kSign + 1));
    } else if (equals != std::string::npos) {
      given.text = plain(line.substr(std::min(equals + kSign, line.size())));
    } else {
      fail("neither a file, arguments nor a sentence");
    }
    if (rows_.empty()) {
      texts_[given.name] = given.text;
    } else {
      rows_.back().files.push_back(std::move(given));
    }
  }

  [[nodiscard]] std::string changed(const std::string& what) const {
    const std::size_t colon = what.find(": ");
    const auto found = texts_.find(what.substr(0, colon));
    if (found == texts_.end()) fail("no such text");
    std::string text = found->second;
    if (colon == std::string::npos) return text;
    const std::string change = what.substr(colon + 2);
    constexpr std::string_view kSign = "=>";
    const std::size_t sign = change.find(kSign);
    if (sign == std::string::npos) fail("no '=>'");
    const std::string from = plain(change.substr(0, sign == 0 ? 0 : sign - 1));
    std::string_view behind = std::string_view(change).substr(sign + kSign.size());
    if (behind.starts_with(' ')) behind.remove_prefix(1);
    const std::string to = plain(behind);
    if (from.empty()) return text + to;
    const std::size_t at = text.find(from);
    if (at == std::string::npos) fail("the text has no such piece");
    return text.replace(at, from.size(), to);
  }

  // Words between spaces; '...' keeps its spaces.
  [[nodiscard]] static std::vector<std::string> words(std::string_view line) {
    std::vector<std::string> all;
    std::string word;
    bool quoted = false;
    bool begun = false;
    for (const char c : line) {
      if (c == '\'') quoted = !quoted;
      const bool ends = c == ' ' && !quoted;
      if (ends && begun) all.push_back(plain(word));
      if (ends) word.clear();
      begun = !ends;
      if (!ends && c != '\'') word += c;
    }
    if (begun) all.push_back(plain(word));
    return all;
  }

  // \n, \r, \xHH and \\ as what they stand for.
  [[nodiscard]] static std::string plain(std::string_view text) {
    constexpr int kHexadecimal = 16;
    std::string result;
    for (std::size_t i = 0; i < text.size(); ++i) {
      const char next = i + 1 < text.size() ? text[i + 1] : '\0';
      if (text[i] != '\\' || std::string_view("nrx\\").find(next) == std::string_view::npos) {
        result += text[i];
        continue;
      }
      ++i;
      if (next == 'n') result += '\n';
      if (next == 'r') result += '\r';
      if (next == '\\') result += '\\';
      if (next != 'x') continue;
      const std::string digits(text.substr(i + 1, 2));
      result += static_cast<char>(std::stoi(digits, nullptr, kHexadecimal));
      i += 2;
    }
    return result;
  }

  const std::regex list_{R"(\(([^()|]*\|[^()]*)\))"};

  std::string path_;
  int line_ = 1;
  std::string section_;
  std::string name_;  // of the row, or "" before the first
  int line_of_name_ = 0;
  std::vector<std::string> lines_;  // of the row
  std::map<std::string, std::string> texts_;
  std::vector<WrongInput> rows_;
};

inline std::vector<WrongInput> read_wrong_inputs(const std::string& path) {
  return WrongInputReader(path).read();
}

}  // namespace hapticwall::command::test
