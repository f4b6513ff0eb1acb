#pragma once
// Finding a command by a few letters of it: what the command palette lists, in which order. Knows no widget.

#include <QString>
#include <QStringList>

#include <functional>
#include <optional>
#include <vector>

namespace prt::ui {

/// Something that the user can do, or a value that he can set.
struct Command {
  QString id;        ///< the same from one start to the next; what recent ones are remembered by
  QString title;     ///< "Frame all"
  QString group;     ///< where it is found otherwise: "View", "Transfer"
  QString detail;    ///< current value of a parameter, or empty
  QString shortcut;  ///< as the keyboard calls it, or empty
  QString tip;       ///< one sentence
  bool enabled = true;
  std::function<void()> run;
};

/// How well letters match a text.
struct FuzzyMatch {
  int score = 0;               ///< higher is better
  std::vector<int> positions;  ///< of the matched letters, ascending
};

/// Every word of `query` (separated by spaces) must be found in `text`, its letters in order but not
/// necessarily side by side; case does not matter. Beginnings of words and letters side by side score higher,
/// letters far apart lower. An empty query matches everything with score 0.
std::optional<FuzzyMatch> fuzzyMatch(const QString& query, const QString& text);

struct RankedCommand {
  int index = 0;               ///< into the commands
  std::vector<int> positions;  ///< matched letters of the title
};

/// The commands that match, best first; among equals those used recently (`recent`, newest first) lead.
/// Without a query the recent ones, then all in their order. A match in the title counts more than one in the
/// group.
std::vector<RankedCommand> rankCommands(const std::vector<Command>& commands, const QString& query,
                                        const QStringList& recent);

}  // namespace prt::ui
