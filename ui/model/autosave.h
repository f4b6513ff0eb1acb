#pragma once
// Keeps the edits of the open document in its recovery place, some seconds after they were made: on a
// thread of its own, so that neither the interface nor a bake waits for the disk.

#include "ui/model/document.h"
#include "ui/model/recovery.h"

#include <QObject>
#include <QThreadPool>
#include <QTimer>

#include <functional>
#include <memory>

namespace prt::ui {

class Autosave : public QObject {
  Q_OBJECT
 public:
  /// `needed`: whether there is anything that would be lost.
  Autosave(Document& document, std::function<bool()> needed, QObject* parent = nullptr);
  ~Autosave() override;

  /// Where to keep the document from now on; null: nowhere. What the former place held stays in it.
  void setPlace(std::shared_ptr<const RecoveryPlace> place);
  /// Time between an edit and when it is kept; 0 turns it off.
  void setMilliseconds(int milliseconds);
  /// Makes a small PNG of the document. Called on this object's thread.
  void setThumbnail(std::function<QByteArray()> make) { thumbnail_ = std::move(make); }

  /// Keeps what is there now, or forgets it when nothing would be lost.
  void write();
  /// The same, and waits for it.
  void flush();

 Q_SIGNALS:
  void kept();
  void failed(const QString& message);

 private:
  RecoveryEntry entry() const;

  Document& document_;
  std::function<bool()> needed_;
  std::function<QByteArray()> thumbnail_;
  std::shared_ptr<const RecoveryPlace> place_;
  QTimer timer_;
  QThreadPool writer_;    // one thread: what is newer is written later
  bool dirty_ = false;    // edits that are not kept yet
  bool holding_ = false;  // the place holds an entry
};

}  // namespace prt::ui
