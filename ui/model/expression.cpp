#include "ui/model/expression.h"

#include <QStringList>

#include <cmath>

namespace prt::ui {

namespace {

// Recursive descent over the text; any step may set `failed`.
class Parser {
 public:
  explicit Parser(const QString& text) : text_(text) {}

  std::optional<double> parse() {
    const double value = sum();
    skipSpaces();
    if (failed_ || at_ != text_.size() || !std::isfinite(value)) return std::nullopt;
    return value;
  }

 private:
  static constexpr int kMaxDepth = 64;

  void skipSpaces() {
    while (at_ < text_.size() && text_[at_].isSpace()) ++at_;
  }
  bool take(QChar c) {
    skipSpaces();
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }
  double fail() {
    failed_ = true;
    return 0;
  }

  double sum() {
    double value = product();
    while (!failed_) {
      if (take(u'+'))
        value += product();
      else if (take(u'-') || take(u'\u2212'))
        value -= product();
      else
        break;
    }
    return value;
  }

  double product() {
    double value = power();
    while (!failed_) {
      if (take(u'*') || take(u'\u00d7'))
        value *= power();
      else if (take(u'/'))
        value /= power();
      else
        break;
    }
    return value;
  }

  // Right-associative; a sign binds less tightly: -2^2 = -4.
  double power() {
    if (++depth_ > kMaxDepth) return fail();
    double value;
    if (take(u'-') || take(u'\u2212'))
      value = -power();
    else if (take(u'+'))
      value = power();
    else {
      value = atom();
      if (!failed_ && take(u'^')) value = std::pow(value, power());
    }
    --depth_;
    return value;
  }

  double atom() {
    if (take(u'(')) {
      if (++depth_ > kMaxDepth) return fail();
      const double value = sum();
      --depth_;
      return take(u')') ? value : fail();
    }
    const double value = number();
    if (take(u'k')) return value * 1e3;
    if (take(u'M')) return value * 1e6;
    return value;
  }

  double number() {
    skipSpaces();
    const qsizetype first = at_;
    const auto digits = [&] {
      while (at_ < text_.size() && text_[at_].isDigit()) ++at_;
    };
    digits();
    if (at_ < text_.size() && text_[at_] == u'.') ++at_, digits();
    if (at_ < text_.size() && (text_[at_] == u'e' || text_[at_] == u'E')) {
      ++at_;
      if (at_ < text_.size() && (text_[at_] == u'+' || text_[at_] == u'-')) ++at_;
      digits();
    }
    bool ok = false;
    const double value = text_.mid(first, at_ - first).toDouble(&ok);
    return ok ? value : fail();
  }

  const QString& text_;
  qsizetype at_ = 0;
  int depth_ = 0;
  bool failed_ = false;
};

}  // namespace

std::optional<double> evaluateExpression(const QString& text, const QString& unit) {
  QString bare = text.trimmed();
  QStringList endings{unit};
  if (unit == u"degrees" || unit == u"\u00b0")
    endings << QStringLiteral("degrees") << QStringLiteral("deg") << QStringLiteral("\u00b0");
  for (const QString& ending : endings)
    if (!ending.isEmpty() && bare.endsWith(ending)) {
      bare.chop(ending.size());
      break;
    }
  return Parser(bare).parse();
}

QString formatNumber(double value, int decimals) {
  QString text = QString::number(value, 'f', decimals);
  if (text.contains(u'.')) {
    while (text.endsWith(u'0')) text.chop(1);
    if (text.endsWith(u'.')) text.chop(1);
  }
  return text == u"-0" ? QStringLiteral("0") : text;
}

QString formatCount(qint64 value) {
  QString text = QString::number(value);
  for (qsizetype i = text.size() - 3; i > (value < 0 ? 1 : 0); i -= 3) text.insert(i, QChar(0x202f));
  return text;
}

QString formatSeconds(double seconds) {
  const qint64 whole = qRound64(seconds);
  if (whole < 1) return QStringLiteral("< 1 s");
  if (whole < 60) return QStringLiteral("%1 s").arg(whole);
  if (whole < 3600) return QStringLiteral("%1 min %2 s").arg(whole / 60).arg(whole % 60);
  return QStringLiteral("%1 h %2 min").arg(whole / 3600).arg(whole % 3600 / 60);
}

}  // namespace prt::ui
