#pragma once
// What people type into number fields: "1.5", "3 * 24", "(1+2)/4", "2k", "45 deg".

#include <QString>

#include <optional>

namespace prt::ui {

/// The value of an arithmetic expression (+ - * / ^, brackets, k and M as factors); `unit` may follow the
/// number. Nothing when it cannot be read or is not finite.
std::optional<double> evaluateExpression(const QString& text, const QString& unit = {});

/// A number as fields show it: no more digits than it needs, at most `decimals` after the point.
QString formatNumber(double value, int decimals);

/// "1 234 567" with thin spaces.
QString formatCount(qint64 value);

/// "12 s", "3 min 20 s", "1 h 5 min".
QString formatSeconds(double seconds);

}  // namespace prt::ui
