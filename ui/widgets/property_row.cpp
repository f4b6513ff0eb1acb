#include "ui/widgets/property_row.h"

#include "libprt/core/error.h"
#include "ui/model/expression.h"
#include "ui/model/told_path.h"
#include "ui/widgets/color_field.h"
#include "ui/widgets/number_field.h"
#include "ui/widgets/theme.h"
#include "ui/widgets/vector_field.h"

#include <nlohmann/json.hpp>

#include <QApplication>
#include <QCheckBox>
#include <QClipboard>
#include <QComboBox>
#include <QContextMenuEvent>
#include <QFileDialog>
#include <QGridLayout>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QMouseEvent>
#include <QToolButton>
#include <QToolTip>

#include <algorithm>
#include <cmath>

namespace prt::ui {

namespace {

constexpr double kLogarithmicFrom = 1000;  // ranges wider than this move by factors

QString symbolOf(const QString& unit) {
  if (unit == u"degrees") return QStringLiteral("\u00b0");
  if (unit == u"times") return QStringLiteral("\u00d7");
  return unit;
}

// "rays per sample" behind the label "Rays" says "per sample".
QString unitBehind(const QString& title, const QString& unit) {
  const QString first = title.toLower();
  return unit.startsWith(first) ? unit.mid(first.size()).trimmed() : symbolOf(unit);
}

NumberFormat formatOf(const Parameter& parameter, const QString& title) {
  NumberFormat format;
  const bool bounded = parameter.high > parameter.low && parameter.high < 1e8;
  if (bounded) {
    format.low = parameter.low;
    format.high = parameter.high;
    format.logarithmic = parameter.low > 0 && parameter.high / parameter.low >= kLogarithmicFrom;
  }
  // The least value can be told from nothing.
  const int fine = format.logarithmic ? std::clamp(int(std::ceil(-std::log10(format.low))), 1, 4) : 3;
  format.decimals = parameter.type == ParameterType::Integer ? 0 : fine;
  format.unit = unitBehind(title, QString::fromStdString(parameter.unit));
  if (parameter.unit == "degrees") format.decimals = 1, format.step = 5;
  return format;
}

QString jsonText(const nlohmann::json& value) {
  return QString::fromStdString(value.dump());
}

}  // namespace

QString parameterTip(const Parameter& p) {
  const auto text = [](const std::string& s) { return QString::fromStdString(s).toHtmlEscaped(); };
  QString tip = QStringLiteral("<p style='white-space:pre-wrap'>%1</p><p>").arg(text(p.doc));
  if (p.high > p.low && p.high < 1e8)
    tip += QObject::tr("Range %1 to %2<br>").arg(formatNumber(p.low, 3), formatNumber(p.high, 3));
  if (!p.unit.empty()) tip += QObject::tr("Unit: %1<br>").arg(text(p.unit));
  tip += QObject::tr("Default %1<br>").arg(text(p.defaultText));
  tip += QObject::tr("Cost of a change: %1<br>").arg(text(p.cost));
  return tip + QStringLiteral("<tt>%1</tt></p>").arg(text(p.path));
}

PropertyRow::PropertyRow(Document& document, const QString& path, const QString& title, QWidget* parent)
    : QWidget(parent),
      document_(document),
      path_(path),
      parameter_(parameterAt(path.toStdString())),
      title_(title.isEmpty() ? parameterTitle(path) : title),
      label_(new QLabel(title_)),
      editor_(makeEditor()),
      reset_(new QToolButton) {
  setObjectName(path);
  setToolTip(parameterTip(parameter_));
  label_->setFixedWidth(kLabelWidth);
  setRole(label_, "muted");
  label_->installEventFilter(this);
  editor_->installEventFilter(this);
  label_->setBuddy(editor_);
  if (qobject_cast<NumberField*>(editor_)) {
    label_->setCursor(Qt::SizeHorCursor);
    label_->setStatusTip(NumberField::hint());
  }
  reset_->setIcon(icon(QStringLiteral("edit-reset")));
  reset_->setIconSize({12, 12});
  reset_->setFixedSize(kResetWidth, kResetWidth);
  reset_->setFocusPolicy(Qt::NoFocus);
  reset_->setToolTip(tr("Back to the default, %1").arg(QString::fromStdString(parameter_.defaultText)));
  QSizePolicy keepsPlace = reset_->sizePolicy();
  keepsPlace.setRetainSizeWhenHidden(true);
  reset_->setSizePolicy(keepsPlace);
  connect(reset_, &QToolButton::clicked, this, &PropertyRow::reset);

  arrange();
  connect(&document_, &Document::recipeChanged, this, &PropertyRow::refresh);
  refresh();
}

// Label, field, reset in a row; the three fields of a vector need a row of their own.
void PropertyRow::arrange() {
  const bool vector = parameter_.type == ParameterType::Vector;
  auto* grid = new QGridLayout(this);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setHorizontalSpacing(kGrid);
  grid->setVerticalSpacing(0);
  grid->addWidget(label_, 0, 0);
  grid->addWidget(editor_, vector ? 1 : 0, vector ? 0 : 1, 1, vector ? 3 : 1);
  grid->addWidget(reset_, 0, 2, Qt::AlignCenter);
  grid->setColumnStretch(1, 1);
  setFixedHeight(vector ? 2 * kRowHeight - 2 : kRowHeight);
}

QString PropertyRow::valueText() const {
  try {
    return jsonText(getByPath(document_.recipe(), path_.toStdString()));
  } catch (const Error&) {
    return {};  // the recipe has no such object or light at the moment
  }
}

bool PropertyRow::isDefault() const {
  const QString value = valueText();
  return value.isEmpty() ||
         nlohmann::json::parse(value.toStdString()) == nlohmann::json::parse(parameter_.defaultText);
}

void PropertyRow::apply(const QString& value) {
  try {
    document_.set(path_, value, title_);
  } catch (const Error& error) {
    refresh();
    QToolTip::showText(editor_->mapToGlobal(QPoint(0, editor_->height())), QString::fromUtf8(error.what()),
                       editor_);
  }
}

void PropertyRow::reset() {
  apply(QString::fromStdString(parameter_.defaultText));
}

void PropertyRow::refresh() {
  const bool exists = !valueText().isEmpty();
  setEnabled(exists);
  if (!exists) return;
  show_();
  reset_->setVisible(!isDefault());
}

QWidget* PropertyRow::makeEditor() {
  switch (parameter_.type) {
    case ParameterType::Integer:
    case ParameterType::Number:
      return makeNumber();
    case ParameterType::Color:
      return makeColor();
    case ParameterType::Choice:
      return makeChoice();
    case ParameterType::Boolean:
      return makeToggle();
    case ParameterType::Vector:
      return makeVector();
    default:
      return makeText();
  }
}

QWidget* PropertyRow::makeNumber() {
  auto* field = new NumberField(formatOf(parameter_, title_));
  connect(field, &NumberField::edited, this,
          [this](double value) { apply(jsonText(nlohmann::json(value))); });
  if (parameter_.type == ParameterType::Integer) {
    field->disconnect(this);
    connect(field, &NumberField::edited, this,
            [this](double value) { apply(QString::number(qint64(value))); });
  }
  connect(field, &NumberField::gestureBegan, this,
          [this] { document_.beginGesture(editName(document_.recipe(), path_, title_)); });
  connect(field, &NumberField::gestureEnded, this, [this] { document_.endGesture(); });
  connect(field, &NumberField::resetRequested, this, &PropertyRow::reset);
  show_ = [this, field] { field->setValue(valueText().toDouble()); };
  return field;
}

QWidget* PropertyRow::makeColor() {
  auto* field = new ColorField(parameter_.high > 1 ? ColorField::Kind::Light : ColorField::Kind::Reflectance);
  connect(field, &ColorField::edited, this, [this](const Rgb& c) {
    apply(jsonText(nlohmann::json{c.x, c.y, c.z}));
  });
  connect(field, &ColorField::gestureBegan, this,
          [this] { document_.beginGesture(editName(document_.recipe(), path_, title_)); });
  connect(field, &ColorField::gestureEnded, this, [this] { document_.endGesture(); });
  show_ = [this, field] {
    const nlohmann::json value = nlohmann::json::parse(valueText().toStdString());
    field->setColor({value[0].get<float>(), value[1].get<float>(), value[2].get<float>()});
  };
  return field;
}

QWidget* PropertyRow::makeChoice() {
  auto* box = new QComboBox;
  box->setFocusPolicy(Qt::StrongFocus);
  for (const std::string& choice : parameter_.choices) box->addItem(QString::fromStdString(choice));
  box->setMinimumContentsLength(6);
  box->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  connect(box, &QComboBox::textActivated, this, &PropertyRow::apply);

  show_ = [this, box] {
    box->setCurrentText(
        QString::fromStdString(getByPath(document_.recipe(), path_.toStdString()).get<std::string>()));
  };
  return box;
}

QWidget* PropertyRow::makeToggle() {
  auto* box = new QCheckBox;
  connect(box, &QCheckBox::clicked, this,
          [this](bool on) { apply(on ? QStringLiteral("true") : QStringLiteral("false")); });
  show_ = [this, box] { box->setChecked(valueText() == u"true"); };
  return box;
}

QWidget* PropertyRow::makeVector() {
  NumberFormat format = formatOf(parameter_, title_);
  format.unit = parameter_.unit == "degrees" ? QStringLiteral("\u00b0") : QString();
  auto* field = new VectorField(format);
  connect(field, &VectorField::edited, this, [this](const Vec3& v) {
    apply(jsonText(nlohmann::json{v.x, v.y, v.z}));
  });
  connect(field, &VectorField::gestureBegan, this,
          [this] { document_.beginGesture(editName(document_.recipe(), path_, title_)); });
  connect(field, &VectorField::gestureEnded, this, [this] { document_.endGesture(); });
  connect(field, &VectorField::resetRequested, this, &PropertyRow::reset);
  show_ = [this, field] {
    const nlohmann::json value = getByPath(document_.recipe(), path_.toStdString());
    field->setValue({value[0].get<float>(), value[1].get<float>(), value[2].get<float>()});
  };
  return field;
}

QWidget* PropertyRow::makeText() {
  auto* field = new QLineEdit;
  if (parameter_.type == ParameterType::File) {
    QAction* browse = field->addAction(icon(QStringLiteral("document-open")), QLineEdit::TrailingPosition);
    browse->setObjectName(QStringLiteral("browse"));
    browse->setToolTip(tr("Choose a file"));
    connect(browse, &QAction::triggered, this, [this] {
      const QString file = QFileDialog::getOpenFileName(window(), tr("Choose a file: %1").arg(label_->text()),
                                                        QString::fromStdString(document_.folder().string()));
      if (!file.isEmpty()) apply(toldPath(document_, file));
    });
  }
  connect(field, &QLineEdit::editingFinished, this, [this, field] { apply(field->text()); });
  show_ = [this, field] {
    const nlohmann::json value = getByPath(document_.recipe(), path_.toStdString());
    field->setText(value.is_string() ? QString::fromStdString(value.get<std::string>()) : jsonText(value));
  };
  return field;
}

// The label scrubs like the field; a double click on it resets.
void PropertyRow::scrubFromLabel(QEvent* event) {
  auto* field = qobject_cast<NumberField*>(editor_);
  if (event->type() == QEvent::MouseButtonDblClick) return reset();
  if (!field) return;
  auto* mouse = static_cast<QMouseEvent*>(event);
  QMouseEvent moved(mouse->type(), field->mapFromGlobal(mouse->globalPosition()), mouse->globalPosition(),
                    mouse->button(), mouse->buttons(), mouse->modifiers());
  QApplication::sendEvent(field, &moved);
}

bool PropertyRow::eventFilter(QObject* watched, QEvent* event) {
  const QEvent::Type type = event->type();
  if (watched == label_ && (type == QEvent::MouseButtonPress || type == QEvent::MouseMove ||
                            type == QEvent::MouseButtonRelease || type == QEvent::MouseButtonDblClick)) {
    if (static_cast<QMouseEvent*>(event)->button() == Qt::RightButton) return false;
    scrubFromLabel(event);
    return true;
  }
  // Everywhere on a row the same menu, but for a text that is being edited.
  const bool typing = qobject_cast<QLineEdit*>(editor_) && editor_->hasFocus();
  if (watched == editor_ && type == QEvent::ContextMenu && !typing) {
    contextMenuEvent(static_cast<QContextMenuEvent*>(event));
    return true;
  }
  // A combo box must not change while a panel is scrolled over it.
  if (watched == editor_ && type == QEvent::Wheel && !editor_->hasFocus()) {
    event->ignore();
    return true;
  }
  return false;
}

void PropertyRow::contextMenuEvent(QContextMenuEvent* event) {
  QMenu menu(this);
  menu.addAction(icon(QStringLiteral("edit-copy")), tr("Copy value"), this,
                 [this] { QApplication::clipboard()->setText(valueText()); });
  menu.addAction(icon(QStringLiteral("edit-paste")), tr("Paste value"), this,
                 [this] { apply(QApplication::clipboard()->text()); });
  QAction* back = menu.addAction(icon(QStringLiteral("edit-reset")),
                                 tr("Reset to %1").arg(QString::fromStdString(parameter_.defaultText)), this,
                                 &PropertyRow::reset);
  back->setEnabled(!isDefault());
  menu.addSeparator();
  menu.addAction(
      icon(QStringLiteral("help-about")), tr("What does this cost?"), this, [this, at = event->globalPos()] {
        QToolTip::showText(
            at, tr("A change of \u201c%1\u201d: %2").arg(title_, QString::fromStdString(parameter_.cost)),
            this);
      });
  menu.exec(event->globalPos());
}

}  // namespace prt::ui
