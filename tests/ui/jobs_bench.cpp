// bench_jobs MESH: how long a bake takes to its first preview, and to answer its cancel button. Prints JSON.

#include "tests/ui/wait.h"
#include "ui/docks/jobs_dock.h"
#include "ui/model/session.h"
#include "ui/widgets/theme.h"

#include <nlohmann/json.hpp>

#include <QAbstractButton>
#include <QApplication>
#include <QElapsedTimer>
#include <QTest>

#include <cstdio>

namespace prt::ui {
namespace {

double milliseconds(const QElapsedTimer& timer) {
  return 1e-6 * double(timer.nsecsElapsed());
}

QAbstractButton* cancelButton(JobsDock& dock) {
  for (auto* each : dock.findChildren<QAbstractButton*>(QStringLiteral("cancelJob")))
    if (each->isVisible()) return each;
  return nullptr;
}

struct Times {
  double opened = 0, preview = 0, answered = 0, done = 0;
};

// Cancels `after` milliseconds behind the first preview.
Times measure(const QString& mesh, int after) {
  Session session;
  JobsDock dock(session.jobs());
  dock.resize(280, 400);
  dock.show();
  Times times;
  QElapsedTimer timer;
  timer.start();
  QElapsedTimer bake;
  QObject::connect(&session.bakes(), &BakeController::changed, [&] {
    if (session.bakes().baking() && !bake.isValid()) bake.start();
  });
  session.open(mesh);
  test::waitFor([&] { return bake.isValid(); });
  times.opened = milliseconds(timer);
  test::waitFor([&] { return session.relighter().transfer() != nullptr; });
  times.preview = milliseconds(bake);
  test::pass(after);
  const quint64 job = session.bakes().job();
  QAbstractButton* button = cancelButton(dock);
  if (!button || !job) return times;
  bake.restart();
  QTest::mouseClick(button, Qt::LeftButton);
  dock.repaint();
  times.answered = milliseconds(bake);
  test::waitFor([&] { return session.jobs().find(job)->over(); });
  times.done = milliseconds(bake);
  session.project().giveUp();
  return times;
}

}  // namespace
}  // namespace prt::ui

int main(int argc, char** argv) {
  QApplication application(argc, argv);
  prt::ui::applyTheme(application, prt::ui::darkTheme());
  if (argc != 2) return 2;
  nlohmann::json runs = nlohmann::json::array();
  for (const int after : {0, 150, 400, 1000, 2000, 3500}) {
    const prt::ui::Times t = prt::ui::measure(QString::fromLocal8Bit(argv[1]), after);
    runs.push_back({{"cancelled_after_ms", after},
                    {"opened_ms", t.opened},
                    {"first_preview_ms", t.preview},
                    {"cancel_answered_ms", t.answered},
                    {"cancel_done_ms", t.done}});
  }
  std::printf("%s\n", nlohmann::json{{"name", "jobs"}, {"runs", runs}}.dump(2).c_str());
  return 0;
}
