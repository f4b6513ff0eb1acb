#include "ui/window/synthesis_actions.h"

#include "ui/model/field_editor.h"
#include "ui/model/layer_editor.h"
#include "ui/model/session.h"
#include "ui/model/wish_editor.h"
#include "ui/window/menu_action.h"

#include <QMenu>

namespace prt::ui {

namespace {

QString tr(const char* text) {
  return QObject::tr(text);
}

}  // namespace

void fillSynthesisMenu(QMenu& menu, Session& session, const std::function<void()>& show) {
  menu.setToolTipsVisible(true);
  FieldEditor& field = session.field();
  WishEditor& wishes = session.wishes();
  Painting& painting = session.painting();
  const auto toggle = [&painting, show](Brush brush) {
    return [&painting, show, brush] {
      const bool takes = painting.brush() != brush;
      if (takes) show();
      painting.take(takes ? brush : Brush::None);
    };
  };
  QAction* strokes =
      addMenuAction(menu, "paintStrokes", tr("&Draw strokes"),
                    tr("Drag on the model: the patch is laid along what is drawn."), toggle(Brush::Strokes));
  strokes->setCheckable(true);
  strokes->setShortcut(QKeySequence(Qt::Key_D));
  QAction* erase = addMenuAction(menu, "eraseStroke", tr("&Erase stroke"), tr("The one that is selected."),
                                 [&field] { field.erase(field.selected()); });
  QAction* all = addMenuAction(menu, "eraseStrokes", tr("Erase &all strokes"),
                               tr("The field is as smooth as it can be."), [&field] { field.eraseAll(); });
  QAction* shown = addMenuAction(menu, "showField", tr("Show the &field"),
                                 tr("Lines along the orientation field, and dots where it winds."),
                                 [&field] { field.setShown(!field.shown()); });
  shown->setCheckable(true);
  menu.addSeparator();
  QAction* parts = addMenuAction(
      menu, "paintParts", tr("Paint &parts"),
      tr("Drag on the model: what is painted takes the part of the patch that was picked in the "
         "Synthesis dock."),
      toggle(Brush::Wishes));
  parts->setCheckable(true);
  parts->setShortcut(QKeySequence(Qt::Key_W));
  QAction* none = addMenuAction(menu, "eraseParts", tr("E&rase all wishes"),
                                tr("The patch goes where it fits best."), [&wishes] { wishes.eraseAll(); });
  QAction* partsShown =
      addMenuAction(menu, "showParts", tr("Show &wishes"), tr("Where parts of the patch are wished for."),
                    [&wishes] { wishes.setShown(!wishes.shown()); });
  partsShown->setCheckable(true);
  menu.addSeparator();
  LayerEditor& layers = session.patchLayers();
  QAction* addLayer = addMenuAction(menu, "addPatchLayer", tr("Add &layer"),
                                    tr("A further patch, which shows where it is painted."), [&layers, show] {
                                      show();
                                      layers.add();
                                    });
  QAction* cover = addMenuAction(
      menu, "paintLayers", tr("&Paint layer"),
      tr("Drag on the model: what is painted shows the layer that is selected in the Synthesis dock."),
      toggle(Brush::Layers));
  cover->setCheckable(true);
  cover->setShortcut(QKeySequence(Qt::Key_P));
  QAction* layersShown =
      addMenuAction(menu, "showLayers", tr("Show la&yers"), tr("Where each layer is painted."),
                    [&layers] { layers.setShown(!layers.shown()); });
  layersShown->setCheckable(true);
  const auto follow = [&session, &field, &wishes, &painting, strokes, erase, all, shown, parts, none,
                       partsShown, &layers, addLayer, cover, layersShown] {
    strokes->setChecked(painting.brush() == Brush::Strokes);
    erase->setEnabled(field.selected() >= 0);
    all->setEnabled(!field.strokes().empty());
    shown->setChecked(field.shown());
    parts->setChecked(painting.brush() == Brush::Wishes);
    parts->setEnabled(session.document().recipe().patch.model != PatchModel::None);
    none->setEnabled(!wishes.wishes().empty());
    partsShown->setChecked(wishes.shown());
    addLayer->setEnabled(layers.canAdd());
    cover->setChecked(painting.brush() == Brush::Layers);
    cover->setEnabled(layers.selected() != LayerEditor::kPatch);
    layersShown->setChecked(layers.shown());
  };
  QObject::connect(&field, &FieldEditor::changed, &menu, follow);
  QObject::connect(&wishes, &WishEditor::changed, &menu, follow);
  QObject::connect(&layers, &LayerEditor::changed, &menu, follow);
  QObject::connect(&session.document(), &Document::recipeChanged, &menu, follow);
  QObject::connect(&painting, &Painting::brushChanged, &menu, follow);
  follow();
}

}  // namespace prt::ui
