// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/yaml_tree.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include "beaconless/core/parse.hpp"
#include "beaconless/io/whole_file.hpp"

namespace beaconless::io {
namespace {

constexpr std::size_t kMaxDepth = 32;
constexpr const char* kTooDeep = "lists and maps are nested too deeply";

/// Leaves the parser from inside an event; caught in read_yaml.
struct Refused {
  int line;
  std::string what;
  std::string remedy;
};

/// Grows a YamlNode from the parser's events: its lines are kept, and what could explode is refused as it
/// comes.
class TreeGrower : public YAML::EventHandler {
 public:
  YamlNode take() { return std::move(root_); }

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (++documents_ > 1) throw Refused{mark.line + 1, "a second document begins here", "keep one to a file"};
  }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t) override { add(mark, YamlNode::Kind::null, {}); }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override {
    throw Refused{mark.line + 1, "aliases (*name) are not read", "write the value out"};
  }
  void OnScalar(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                const std::string& text) override {
    add(mark, YamlNode::Kind::scalar, text);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                       YAML::EmitterStyle::value) override {
    open(mark, YamlNode::Kind::list);
  }
  void OnSequenceEnd() override { close(); }
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                  YAML::EmitterStyle::value) override {
    open(mark, YamlNode::Kind::map);
  }
  void OnMapEnd() override { close(); }

 private:
  struct Open {
    YamlNode node;
    std::set<std::string> keys;
  };

  void add(const YAML::Mark& mark, YamlNode::Kind kind, const std::string& text) {
    attach(YamlNode{kind, mark.line + 1, text, {}});
  }
  void open(const YAML::Mark& mark, YamlNode::Kind kind) {
    if (open_.size() == kMaxDepth) throw Refused{mark.line + 1, kTooDeep, "is it the right file?"};
    open_.push_back({YamlNode{kind, mark.line + 1, {}, {}}, {}});
  }
  void close() {
    YamlNode done = std::move(open_.back().node);
    open_.pop_back();
    attach(std::move(done));
  }
  void attach(YamlNode node) {
    if (open_.empty()) {
      root_ = std::move(node);
      return;
    }
    Open& parent = open_.back();
    if (parent.node.kind == YamlNode::Kind::map) {
      if (parent.node.items.size() % 2 == 0)
        check_key(parent, node);
      else if (node.kind == YamlNode::Kind::null)  // the parser sees it where the next thing begins
        node.line = parent.node.items.back().line;
    }
    parent.node.items.push_back(std::move(node));
  }
  static void check_key(Open& parent, const YamlNode& key) {
    if (key.kind != YamlNode::Kind::scalar)
      throw Refused{key.line, "a key is " + key.described(), "keys are words"};
    if (!parent.keys.insert(key.text).second)
      throw Refused{key.line, "the key " + key.described() + " comes twice", "keep one of them"};
  }

  YamlNode root_;
  std::vector<Open> open_;
  int documents_ = 0;
};

/// The line where the brackets that were opened and not closed become too many; 0 when they never do.
///
/// The parser keeps every open bracket of a line in memory, some 240 bytes each, before it tells of the
/// first; brackets in texts and comments count here too, which is why the limit is far from kMaxDepth.
int line_of_too_many_brackets(std::string_view bytes) {
  constexpr int kMaxOpen = 1000;
  int open = 0;
  int line = 1;
  for (const char c : bytes) {
    if (c == '[' || c == '{') ++open;
    if ((c == ']' || c == '}') && open > 0) --open;
    if (c == '\n') ++line;
    if (open > kMaxOpen) return line;
  }
  return 0;
}

bool is_plain(std::string_view text) {
  constexpr std::string_view kSafe = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./+-";
  if (text.empty() || text.find_first_not_of(kSafe) != std::string_view::npos) return false;
  if (text.front() == '-' || text.find("---") != std::string_view::npos || text == "...")
    return parse_double(text).has_value();
  for (const char* word : {"null", "Null", "NULL"})
    if (text == word) return false;
  return true;
}

}  // namespace

const YamlNode* YamlNode::find(std::string_view name) const {
  if (kind != Kind::map) return nullptr;
  for (std::size_t i = 0; i < size(); ++i)
    if (key(i).text == name) return &value(i);
  return nullptr;
}

std::optional<double> YamlNode::number() const {
  if (kind != Kind::scalar) return std::nullopt;
  const auto number = parse_double(text);
  return number && std::isfinite(*number) ? number : std::nullopt;
}

std::string YamlNode::described() const {
  constexpr std::size_t kShown = 60;
  switch (kind) {
    case Kind::null:
      return "nothing";
    case Kind::scalar:
      return "\"" + (text.size() <= kShown ? text : text.substr(0, kShown) + "…") + "\"";
    case Kind::list:
      return "a list of " + std::to_string(size());
    case Kind::map:
      return "a map";
  }
  return "nothing";
}

Result<YamlNode> read_yaml(const std::string& path) {
  auto bytes = read_whole_file(path, kMaxYamlBytes);
  if (!bytes) return bytes.error();
  return parse_yaml(path, std::move(bytes).value());
}

Result<YamlNode> parse_yaml(const std::string& path, std::string bytes) {
  if (const int line = line_of_too_many_brackets(bytes); line > 0)
    return Error{path + ":" + std::to_string(line), kTooDeep, "is it the right file?"};
  TreeGrower grower;
  try {
    std::istringstream in(std::move(bytes));
    YAML::Parser parser(in);
    while (parser.HandleNextDocument(grower)) {
    }
  } catch (const Refused& refused) {
    return Error{path + ":" + std::to_string(refused.line), refused.what, refused.remedy};
  } catch (const YAML::Exception& error) {
    const std::string line = error.mark.is_null() ? "" : ":" + std::to_string(error.mark.line + 1);
    return Error{path + line, "is not YAML: " + error.msg, "is it the right file?"};
  } catch (const std::exception& error) {
    return Error{path, std::string("is not YAML: ") + error.what(), "is it the right file?"};
  }
  return grower.take();
}

std::string where_in(const std::string& path, const YamlNode& node) {
  return path + ":" + std::to_string(node.line);
}

std::string yaml_text(std::string_view text) {
  if (is_plain(text)) return std::string(text);
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      quoted += {'\\', c};
    else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F)
      quoted += fmt::format("\\x{:02X}", static_cast<unsigned>(c));
    else
      quoted += c;
  }
  return quoted + "\"";
}

std::string yaml_number(double value) { return fmt::format("{}", value); }

}  // namespace beaconless::io
