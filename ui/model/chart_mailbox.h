#pragma once
// How jobs find the chart editor while it lives. Internal to it.

#include "ui/model/chart_editor.h"

#include <mutex>

namespace prt::ui {

struct ChartEditor::Mailbox {
  std::mutex mutex;
  ChartEditor* owner = nullptr;

  /// Calls on the editor's thread, in the order of the posts.
  template <class Call>
  void post(Call call) {
    const std::lock_guard lock(mutex);
    if (owner)
      QMetaObject::invokeMethod(
          owner, [o = owner, call] { call(*o); }, Qt::QueuedConnection);
  }
};

}  // namespace prt::ui
