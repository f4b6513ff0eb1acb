#include "ui/docks/error_section.h"

#include "ui/model/error_estimate.h"
#include "ui/model/session.h"
#include "ui/widgets/theme.h"

#include <QComboBox>
#include <QGridLayout>
#include <QLabel>
#include <QPainter>
#include <QPushButton>

namespace prt::ui {

/// A share of the whole as a bar.
class ShareBar : public QWidget {
 public:
  ShareBar() {
    setFixedHeight(6);
    setMinimumWidth(40);
  }
  void setShare(double share) {
    share_ = share;
    update();
  }

 protected:
  void paintEvent(QPaintEvent*) override {
    QPainter painter(this);
    painter.fillRect(rect(), theme().field);
    painter.fillRect(QRectF(0, 0, share_ * width(), height()), theme().accent);
  }

 private:
  double share_ = 0;
};

namespace {

constexpr ErrorShown kCauses[] = {ErrorShown::MonteCarlo, ErrorShown::Interpolation, ErrorShown::Truncation};

QString causeTip(ErrorShown cause) {
  switch (cause) {
    case ErrorShown::MonteCarlo:
      return QObject::tr("Noise of the rays. More rays lower it.");
    case ErrorShown::Interpolation:
      return QObject::tr(
          "Pictures interpolate between vertices; shadows that end between two of them are blurred. More "
          "vertices lower it.");
    default:
      return QObject::tr(
          "What the light has beyond the bands that are baked (up to 10), and what the window takes off. "
          "More bands lower it.");
  }
}

}  // namespace

ErrorSection::ErrorSection(Session& session, QWidget* parent)
    : Section(tr("Where is this bake wrong?"), parent),
      session_(session),
      shown_(new QComboBox),
      judge_(new QComboBox),
      measure_(new QPushButton),
      table_(makeTable()),
      advice_(new QLabel),
      apply_(new QPushButton) {
  shown_->setObjectName(QStringLiteral("errorShown"));
  for (int i = 0; i < kErrorsShown; ++i) shown_->addItem(errorName(ErrorShown(i)));
  judge_->setObjectName(QStringLiteral("errorJudge"));
  judge_->addItems({tr("this light"), tr("any light")});
  measure_->setObjectName(QStringLiteral("measureErrors"));
  apply_->setObjectName(QStringLiteral("applySuggestion"));
  apply_->setToolTip(tr("Makes the change that lowers the error most; one step of undo."));
  advice_->setObjectName(QStringLiteral("errorAdvice"));
  advice_->setWordWrap(true);
  add(fieldRow(tr("Overlay"), shown_,
               tr("The error laid over the surface as false colour; E steps through.")));
  add(fieldRow(
      tr("Judged by"), judge_,
      tr("The light of the moment, or all light that may come: random, its bands falling as 1/(l+1).")));
  add(table_);
  add(measure_);
  add(advice_);
  add(apply_);
  ErrorEstimate& errors = session_.errors();
  connect(shown_, &QComboBox::activated, &errors, [&errors](int index) { errors.show(ErrorShown(index)); });
  connect(judge_, &QComboBox::activated, &errors, [&errors](int index) { errors.setByPrior(index == 1); });
  connect(measure_, &QPushButton::clicked, &errors, [&errors] {
    if (errors.measuring())
      errors.cancel();
    else
      errors.measure();
  });
  connect(apply_, &QPushButton::clicked, &errors, &ErrorEstimate::applySuggestion);
  connect(&errors, &ErrorEstimate::changed, this, &ErrorSection::refresh);
  connect(&session_, &Session::statusChanged, this, &ErrorSection::refresh);
  refresh();
}

QWidget* ErrorSection::makeTable() {
  auto* table = new QWidget;
  auto* grid = new QGridLayout(table);
  grid->setContentsMargins(0, kGrid, 0, kGrid);
  grid->setHorizontalSpacing(2 * kGrid);
  grid->setVerticalSpacing(kGrid / 2);
  grid->setColumnStretch(1, 1);
  const auto number = [&](int row) {
    auto* label = new QLabel;
    label->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
    grid->addWidget(label, row, 2);
    return label;
  };
  for (int i = 0; i < 3; ++i) {
    auto* name = new QLabel(errorName(kCauses[i]));
    name->setToolTip(causeTip(kCauses[i]));
    setRole(name, "muted");
    grid->addWidget(name, i, 0);
    shares_[std::size_t(i)] = new ShareBar;
    shares_[std::size_t(i)]->setToolTip(tr("Share of the mean square"));
    grid->addWidget(shares_[std::size_t(i)], i, 1, Qt::AlignVCenter);
    numbers_[std::size_t(i) + 1] = number(i);
  }
  auto* total = new QLabel(tr("total"));
  total->setToolTip(
      tr("Root-mean-square error of irradiance over the surface, relative to its root-mean-square."));
  grid->addWidget(total, 3, 0);
  numbers_[0] = number(3);
  numbers_[0]->setObjectName(QStringLiteral("errorTotal"));
  return table;
}

void ErrorSection::refresh() {
  const ErrorEstimate& errors = session_.errors();
  const ErrorMap* map = errors.map();
  shown_->setCurrentIndex(int(errors.shown()));
  judge_->setCurrentIndex(errors.byPrior() ? 1 : 0);
  const bool possible = errors.possible() || map;
  shown_->setEnabled(possible || errors.shown() != ErrorShown::Off);
  measure_->setVisible(errors.measuring() || !map);
  measure_->setEnabled(errors.measuring() || errors.possible());
  measure_->setIcon(icon(errors.measuring() ? QStringLiteral("process-stop") : QStringLiteral("run-build")));
  measure_->setText(errors.measuring() ? tr("Cancel") : tr("Estimate"));
  measure_->setToolTip(errors.possible()
                           ? tr("Measures the error of this bake; takes about as long as the bake did.")
                       : session_.document().recipe().transfer.where == TransferWhere::Texel
                           ? tr("Only of transfer at the vertices.")
                           : tr("Possible once the bake is final."));
  table_->setVisible(map);
  for (std::size_t i = 0; map && i < 3; ++i) {
    const bool known = i != ErrorMap::Interpolation || errors.complete();
    shares_[i]->setShare(map->share(ErrorMap::Component(i)));
    numbers_[i + 1]->setText(known ? percentText(map->rms[int(i)]) : QStringLiteral("\u2026"));
  }
  if (map) numbers_[0]->setText(percentText(map->totalRms()));
  const auto suggestion = errors.suggestion();
  advice_->setVisible(suggestion.has_value());
  apply_->setVisible(suggestion && !suggestion->changes.empty());
  if (!suggestion) return;
  const bool button = !suggestion->changes.empty();
  advice_->setText(button ? suggestion->effect
                          : suggestion->text + QStringLiteral(": ") + suggestion->effect);
  setRole(advice_, "muted");
  apply_->setText(suggestion->text);
}

}  // namespace prt::ui
