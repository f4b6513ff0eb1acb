#include "ui/docks/layer_section.h"

#include "ui/model/layer_editor.h"
#include "ui/model/session.h"
#include "ui/widgets/icon.h"
#include "ui/widgets/number_field.h"
#include "ui/widgets/property_row.h"
#include "ui/widgets/theme.h"

#include <QCheckBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QListWidget>
#include <QPushButton>
#include <QSignalBlocker>
#include <QToolButton>

namespace prt::ui {

namespace {

/// The colour that the layer has on the model.
QIcon swatch(int layer) {
  constexpr int kSide = 12;
  QPixmap pixmap(kSide, kSide);
  const Rgb c = layer == LayerEditor::kPatch ? Rgb(0.45f) : colorOfLayer(layer);
  pixmap.fill(QColor::fromRgbF(c.x, c.y, c.z));
  return QIcon(pixmap);
}

QToolButton* toolButton(const char* name, const char* iconName, const QString& text, const QString& tip) {
  auto* button = new QToolButton;
  button->setObjectName(QLatin1String(name));
  button->setIcon(icon(QLatin1String(iconName)));
  button->setText(text);
  if (!text.isEmpty()) button->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  button->setToolTip(tip);
  return button;
}

QPushButton* pushButton(const char* name, const QString& text, const QString& tip) {
  auto* button = new QPushButton(text);
  button->setObjectName(QLatin1String(name));
  button->setToolTip(tip);
  button->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  return button;
}

}  // namespace

LayerSection::LayerSection(Session& session, QWidget* parent)
    : Section(tr("Layers"), parent),
      session_(session),
      layers_(session.patchLayers()),
      painting_(session.painting()),
      list_(new QListWidget),
      state_(new QLabel) {
  makeList();
  add(list_);
  add(makeBar());
  makeBrush();
  connect(&layers_, &LayerEditor::changed, this, &LayerSection::refresh);
  connect(&painting_, &Painting::brushChanged, this, &LayerSection::refresh);
  connect(&session_.document(), &Document::recipeChanged, this, &LayerSection::refresh);
  refresh();
}

int LayerSection::layerOf(int row) const {
  return layers_.count() - 1 - row;
}
int LayerSection::rowOf(int layer) const {
  return layers_.count() - 1 - layer;
}

void LayerSection::makeList() {
  list_->setObjectName(QStringLiteral("layerList"));
  list_->setEditTriggers(QAbstractItemView::DoubleClicked | QAbstractItemView::EditKeyPressed);
  list_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  list_->setVerticalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  list_->setUniformItemSizes(true);
  list_->setToolTip(
      tr("Patches one over the other. The selected one is edited in the Patch dock and painted on the model; "
         "double-click renames it."));
  connect(list_, &QListWidget::currentRowChanged, this, [this](int row) {
    if (row >= 0) layers_.select(layerOf(row));
  });
  // Queued: a rename fills the list anew, and the item that tells of it must outlive its telling.
  connect(list_, &QListWidget::itemChanged, this, [this](QListWidgetItem* item) {
    QMetaObject::invokeMethod(
        this,
        [this, layer = layerOf(list_->row(item)), name = item->text()] {
          layers_.rename(layer, name);
          refresh();
        },
        Qt::QueuedConnection);
  });
}

QWidget* LayerSection::makeBar() {
  add_ = toolButton("addLayer", "list-add", tr("Add layer"),
                    tr("A patch over all others, which shows where it is painted; three at most."));
  remove_ = toolButton("removeLayer", "edit-delete", {}, tr("Remove the selected layer."));
  connect(add_, &QToolButton::clicked, this, [this] { layers_.add(); });
  connect(remove_, &QToolButton::clicked, this, [this] { layers_.remove(layers_.selected()); });
  auto* bar = new QWidget;
  auto* layout = new QHBoxLayout(bar);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(kGrid / 2);
  layout->addWidget(add_);
  layout->addStretch(1);
  layout->addWidget(remove_);
  return bar;
}

void LayerSection::makeBrush() {
  const QString spots = parameterTip(parameterAt("layers[].spots"));
  width_ = new NumberField({.low = LayerEditor::kLeastWidth,
                            .high = LayerEditor::kMostWidth,
                            .decimals = 3,
                            .logarithmic = true,
                            .unit = QString::fromStdString(parameterAt("field.width").unit)});
  width_->setObjectName(QStringLiteral("layerBrushWidth"));
  connect(width_, &NumberField::edited, this, [this](double width) { layers_.setWidth(float(width)); });
  strength_ = new NumberField({.low = LayerEditor::kLeastStrength, .high = 1, .decimals = 2, .unit = {}});
  strength_->setObjectName(QStringLiteral("layerBrushStrength"));
  connect(strength_, &NumberField::edited, this,
          [this](double strength) { layers_.setStrength(float(strength)); });
  Section::add(
      fieldRow(tr("Brush"), width_,
               tr("Radius of the brush relative to the diagonal of the bounding box; [ and ] change it "
                  "while painting.")));
  Section::add(fieldRow(tr("Strength"), strength_,
                        tr("How much of what is below the brush covers: 1 all of it, less blends the two.")));
  paint_ =
      pushButton("paintLayer", tr("Paint layer"),
                 tr("<p>The brush (P): drag on the model; what is painted shows the selected layer. Ctrl "
                    "erases, Esc leaves.</p>") +
                     spots);
  paint_->setCheckable(true);
  connect(paint_, &QPushButton::clicked, this,
          [this] { painting_.take(painting_.brush() == Brush::Layers ? Brush::None : Brush::Layers); });
  erase_ = pushButton("uncoverLayer", tr("Erase all"), spots);
  connect(erase_, &QPushButton::clicked, this, [this] { layers_.eraseAll(); });
  auto* row = new QHBoxLayout;
  row->setContentsMargins(0, 2, 0, 2);
  row->setSpacing(kGrid);
  row->addWidget(paint_, 1);
  row->addWidget(erase_, 1);
  addLayout(row);
  shown_ = new QCheckBox(tr("Layers on the surface"));
  shown_->setObjectName(QStringLiteral("showLayers"));
  shown_->setToolTip(tr("Where each layer is painted, in its colour."));
  connect(shown_, &QCheckBox::clicked, this, [this](bool on) { layers_.setShown(on); });
  Section::add(shown_);
  state_->setObjectName(QStringLiteral("layersState"));
  state_->setWordWrap(true);
  Section::add(state_);
}

void LayerSection::refreshList() {
  const QSignalBlocker quiet(list_);
  const auto& recipe = session_.document().recipe();
  const int rows = layers_.count() + 1;
  while (list_->count() > rows) delete list_->takeItem(list_->count() - 1);
  while (list_->count() < rows) list_->addItem(new QListWidgetItem);
  for (int row = 0; row < rows; ++row) {
    const int layer = layerOf(row);
    QListWidgetItem* item = list_->item(row);
    const bool patch = layer == LayerEditor::kPatch;
    item->setText(patch ? tr("patch") : QString::fromStdString(recipe.layers[std::size_t(layer)].name));
    item->setIcon(swatch(layer));
    Qt::ItemFlags flags = Qt::ItemIsEnabled | Qt::ItemIsSelectable;
    if (!patch) flags |= Qt::ItemIsEditable;
    item->setFlags(flags);
    item->setSizeHint({0, kRowHeight});
  }
  list_->setFixedHeight(rows * kRowHeight + 2 * list_->frameWidth());
  list_->setCurrentRow(rowOf(layers_.selected()));
}

void LayerSection::refresh() {
  if (layers_.count() != int(session_.document().recipe().layers.size())) return;  // it is told next
  refreshList();
  const bool layer = layers_.selected() != LayerEditor::kPatch;
  add_->setEnabled(layers_.canAdd());
  remove_->setEnabled(layer);
  paint_->setEnabled(layer);
  paint_->setChecked(painting_.brush() == Brush::Layers);
  erase_->setEnabled(layer && !layers_.spotsOf(layers_.selected()).empty());
  shown_->setChecked(layers_.shown());
  shown_->setEnabled(layers_.count() > 0);
  width_->setEnabled(layer), strength_->setEnabled(layer);
  width_->setValue(double(layers_.width()));
  strength_->setValue(double(layers_.strength()));
  const bool failed = !layers_.error().isEmpty();
  const int spots = layer ? int(layers_.spotsOf(layers_.selected()).size()) : 0;
  state_->setText(failed       ? layers_.error()
                  : !layer     ? QString()
                  : spots == 0 ? tr("Shows nothing yet: paint it on the model.")
                  : spots == 1 ? tr("1 spot")
                               : tr("%1 spots").arg(spots));
  setRole(state_, failed ? "failed" : "muted");
  state_->setVisible(!state_->text().isEmpty());
}

}  // namespace prt::ui
