#pragma once
// The id map on the model: every place of the surface in the colour of the place in the patch that it shows,
// u in red and v in green (figure 2 of Bi-Scale Radiance Transfer). Follows the products as they arrive,
// previews too.

#include "libprt/atlas/atlas.h"
#include "libprt/synthesis/id_map.h"
#include "ui/model/bake_controller.h"

#include <QObject>

#include <memory>

namespace prt::ui {

class Session;

class IdView : public QObject {
  Q_OBJECT
 public:
  explicit IdView(Session& session, QObject* parent = nullptr);

  bool shown() const { return shown_; }
  void setShown(bool shown);
  /// There is a map to show.
  bool available() const { return atlas_ && map_; }

 Q_SIGNALS:
  void changed();

 private:
  void take(const QString& stage, const ProductState& state);
  void paint();

  Session& session_;
  std::shared_ptr<const Atlas> atlas_;
  std::shared_ptr<const IdMap> map_;
  bool shown_ = false;
};

}  // namespace prt::ui
