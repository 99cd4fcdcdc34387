#include "tests/lint/texts.h"

#include <algorithm>
#include <cctype>
#include <regex>
#include <sstream>

namespace restlab::lint {

namespace {

std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::string trimmed(const std::string& text) {
  const size_t first = text.find_first_not_of(" \t");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

bool hasLetter(const std::string& word) {
  for (const char c : word)
    if (std::isalnum(static_cast<unsigned char>(c)) || (c & 0x80) != 0) return true;
  return false;
}

// Returns whether a sentence ends with this word, if the next one begins with `next`.
bool endsSentence(std::string word, const std::string& next) {
  while (!word.empty() && std::string("'\")*`").find(word.back()) != std::string::npos)
    word.pop_back();
  if (word.empty() || std::string(".!?").find(word.back()) == std::string::npos) return false;
  return !next.empty() && (std::isupper(static_cast<unsigned char>(next[0])) ||
                           std::string("`*[(\"").find(next[0]) != std::string::npos);
}

struct Paragraph {
  int line = 0;
  std::string text;
};

std::vector<Paragraph> paragraphsOf(const std::string& text) {
  static const std::regex item("\\s*([-*]|[0-9]+\\.)\\s+(.*)");
  std::vector<Paragraph> all;
  Paragraph now;
  const auto end = [&] {
    if (!now.text.empty()) all.push_back(now);
    now = {};
  };
  bool isCode = false;
  int number = 0;
  for (const std::string& line : linesOf(text)) {
    ++number;
    if (trimmed(line).starts_with("```")) {
      isCode = !isCode;
      end();
      continue;
    }
    const std::string bare = trimmed(line);
    const bool isIndented = line.starts_with("    ") && now.text.empty();
    if (isCode || isIndented || bare.empty() || bare[0] == '#' || bare[0] == '|') {
      if (!isIndented) end();
      continue;
    }
    std::smatch match;
    if (std::regex_match(line, match, item)) {
      end();
      now = {number, match[2]};
    } else {
      if (now.text.empty()) now.line = number;
      now.text += (now.text.empty() ? "" : " ") + bare;
    }
  }
  end();
  return all;
}

}  // namespace

std::vector<Finding> findRiddles(const std::string& path, const std::string& text) {
  static const std::vector<std::string> kStarts = {"Of ",   "Those ", "Who ",       "Whose ",
                                                   "What ", "As it ", "That which "};
  std::vector<Finding> found;
  bool wasComment = false;
  int number = 0;
  for (const std::string& line : linesOf(text)) {
    ++number;
    const size_t at = line.find("// ");
    const bool isComment = trimmed(line).starts_with("//");
    const bool begins = at != std::string::npos && !(isComment && wasComment);
    wasComment = isComment;
    if (!begins) continue;
    const std::string comment = line.substr(at + 3);
    for (const std::string& start : kStarts) {
      if (comment.starts_with(start))
        found.push_back({path, number, "begins with '" + trimmed(start) + "': " + comment});
    }
  }
  return found;
}

std::vector<Finding> findLongSentences(const std::string& path, const std::string& text,
                                       size_t most) {
  std::vector<Finding> found;
  for (const Paragraph& paragraph : paragraphsOf(text)) {
    std::vector<std::string> words;
    std::istringstream stream(paragraph.text);
    for (std::string word; stream >> word;) words.push_back(word);
    size_t count = 0, first = 0;
    for (size_t i = 0; i < words.size(); ++i) {
      if (hasLetter(words[i])) ++count;
      if (i + 1 < words.size() && !endsSentence(words[i], words[i + 1])) continue;
      if (count > most) {
        std::string start;
        for (size_t k = first; k < std::min(first + 8, words.size()); ++k) start += words[k] + " ";
        found.push_back({path, paragraph.line, std::to_string(count) + " words: " + start + "..."});
      }
      count = 0;
      first = i + 1;
    }
  }
  return found;
}

std::vector<Finding> findMissingPaths(const std::string& path, const std::string& text,
                                      const std::set<std::string>& paths) {
  static const std::regex named(
      "(?:^|[^\\w/.$}-])((?:core|integrators|denoise|experiments|tests|docs|cmake)/[\\w/.-]*\\w)");
  std::vector<Finding> found;
  int number = 0;
  for (const std::string& line : linesOf(text)) {
    ++number;
    for (std::sregex_iterator i(line.begin(), line.end(), named), end; i != end; ++i) {
      const std::string one = (*i)[1];
      const size_t after = size_t(i->position(1)) + one.size();
      // Patterns (tests/a_*) and placeholders name no file.
      if (after < line.size() && std::string("*_{<$").find(line[after]) != std::string::npos)
        continue;
      // A file without its extension, or the beginning of a name as in "path_shift": next in order.
      const auto next = paths.lower_bound(one);
      const bool exists =
          next != paths.end() && next->starts_with(one) &&
          (next->size() == one.size() || (*next)[one.size()] == '.' || (*next)[one.size()] == '/');
      if (!exists && !paths.contains(one)) found.push_back({path, number, "no file " + one});
    }
  }
  return found;
}

}  // namespace restlab::lint
