#include "ui/model/command_index.h"

#include <algorithm>
#include <limits>

namespace prt::ui {

namespace {

constexpr int kNo = std::numeric_limits<int>::min() / 2;
constexpr int kLetter = 4, kSideBySide = 8, kWordStart = 10, kTextStart = 6;
constexpr int kInTitle = 40;  // a word found in the title rather than beside it
constexpr int kRecent = 12;   // used lately

bool startsWord(const QString& text, int at) {
  if (at == 0) return true;
  const QChar before = text[at - 1], here = text[at];
  return !before.isLetterOrNumber() || (before.isLower() && here.isUpper()) ||
         (before.isLetter() && here.isDigit());
}

// The best placing of one word's letters: best[i][j] = score with letter i on place j.
std::optional<FuzzyMatch> matchWord(const QString& word, const QString& text) {
  const int n = int(word.size()), m = int(text.size());
  std::vector<std::vector<int>> best(std::size_t(n), std::vector<int>(std::size_t(m), kNo)), from = best;
  for (int i = 0; i < n; ++i) {
    int reachable = kNo, reachableAt = -1;  // best of the letter before, anywhere to the left
    for (int j = 0; j < m; ++j) {
      if (i > 0 && j > 0 && best[std::size_t(i - 1)][std::size_t(j - 1)] >= reachable) {
        reachable = best[std::size_t(i - 1)][std::size_t(j - 1)];
        reachableAt = j - 1;
      }
      if (reachable > kNo) --reachable;  // a letter further away
      if (text[j].toCaseFolded() != word[i].toCaseFolded()) continue;
      const int letter = kLetter + (startsWord(text, j) ? kWordStart : 0) + (j == 0 ? kTextStart : 0);
      if (i == 0) {
        best[0][std::size_t(j)] = letter;
        continue;
      }
      const int beside = j > 0 ? best[std::size_t(i - 1)][std::size_t(j - 1)] + kSideBySide : kNo;
      if (std::max(beside, reachable) <= kNo / 2) continue;
      best[std::size_t(i)][std::size_t(j)] = std::max(beside, reachable) + letter;
      from[std::size_t(i)][std::size_t(j)] = beside >= reachable ? j - 1 : reachableAt;
    }
  }
  const auto& last = best[std::size_t(n - 1)];
  const auto end = std::max_element(last.begin(), last.end());
  if (end == last.end() || *end <= kNo / 2) return {};
  FuzzyMatch match{*end, {}};
  for (int i = n - 1, j = int(end - last.begin()); i >= 0; j = from[std::size_t(i)][std::size_t(j)], --i)
    match.positions.push_back(j);
  std::reverse(match.positions.begin(), match.positions.end());
  return match;
}

QStringList wordsOf(const QString& query) {
  return query.split(u' ', Qt::SkipEmptyParts);
}

// Each word in the title, or else in what stands beside it.
std::optional<FuzzyMatch> matchCommand(const QStringList& words, const Command& command) {
  FuzzyMatch all;
  for (const QString& word : words) {
    const auto title = matchWord(word, command.title);
    if (title) {
      all.score += title->score + kInTitle;
      all.positions.insert(all.positions.end(), title->positions.begin(), title->positions.end());
      continue;
    }
    const auto beside = matchWord(word, command.group + u' ' + command.title + u' ' + command.id);
    if (!beside) return {};
    all.score += beside->score;
  }
  all.score -= int(command.title.size()) / 4;  // of equal matches the shorter title is the nearer one
  std::sort(all.positions.begin(), all.positions.end());
  return all;
}

}  // namespace

std::optional<FuzzyMatch> fuzzyMatch(const QString& query, const QString& text) {
  FuzzyMatch all;
  for (const QString& word : wordsOf(query)) {
    const auto match = matchWord(word, text);
    if (!match) return {};
    all.score += match->score;
    all.positions.insert(all.positions.end(), match->positions.begin(), match->positions.end());
  }
  std::sort(all.positions.begin(), all.positions.end());
  return all;
}

std::vector<RankedCommand> rankCommands(const std::vector<Command>& commands, const QString& query,
                                        const QStringList& recent) {
  const QStringList words = wordsOf(query);
  struct Found {
    int score, recency;
    RankedCommand command;
  };
  std::vector<Found> found;
  for (int i = 0; i < int(commands.size()); ++i) {
    const Command& command = commands[std::size_t(i)];
    auto match = matchCommand(words, command);
    if (!match) continue;
    const qsizetype used = recent.indexOf(command.id);
    const int recency = used < 0 ? int(recent.size()) : int(used);
    int score = words.isEmpty() ? 0 : match->score;
    if (!words.isEmpty() && used >= 0) score += std::max(1, kRecent - recency);
    if (!command.enabled) score -= kRecent;
    found.push_back({score, recency, {i, std::move(match->positions)}});
  }
  std::stable_sort(found.begin(), found.end(), [](const Found& a, const Found& b) {
    return a.score != b.score ? a.score > b.score : a.recency < b.recency;
  });
  std::vector<RankedCommand> ranked;
  for (Found& f : found) ranked.push_back(std::move(f.command));
  return ranked;
}

}  // namespace prt::ui
