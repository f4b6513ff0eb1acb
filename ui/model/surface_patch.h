#pragma once
// Keeps the picture's patch in step with the products: when one that the patch on the surface is made of
// arrives, it is put together anew, in the background, and handed to the relighter.

#include "ui/model/bake_controller.h"
#include "ui/model/document.h"
#include "ui/model/relighter.h"

#include <QObject>

namespace prt::ui {

class SurfacePatch : public QObject {
  Q_OBJECT
 public:
  SurfacePatch(Document& document, BakeController& bakes, Relighter& relighter, JobRunner& jobs,
               QObject* parent = nullptr);

 private:
  void take(const QString& stage, const ProductState& state);
  void followFilter();
  void makeAnew();

  Document& document_;
  BakeController& bakes_;
  Relighter& relighter_;
  JobRunner& jobs_;
  bool filter_ = false;  // of the newest
  quint64 made_ = 0;     // number of the newest: results of older ones are dropped
};

}  // namespace prt::ui
