#include "ui/document_menu.h"

#include "libprt/project/backups.h"
#include "ui/dialogs/relink_dialog.h"
#include "ui/model/expression.h"
#include "ui/model/session.h"
#include "ui/widgets/theme.h"

#include <QActionGroup>
#include <QFileDialog>
#include <QFileInfo>
#include <QMainWindow>
#include <QMenu>
#include <QMessageBox>
#include <QPushButton>

namespace prt::ui {

namespace {

constexpr int kListed = 20;  // steps of the history on each side

QAction* add(QMenu* menu, const char* iconName, const QString& text, const QKeySequence& keys,
             std::function<void()> run) {
  QAction* action = menu->addAction(icon(QString::fromLatin1(iconName)), text);
  action->setShortcut(keys);
  QObject::connect(action, &QAction::triggered, menu, std::move(run));
  return action;
}

QString listed(QStringList names) {
  constexpr int kMost = 4;
  const qsizetype more = names.size() - kMost;
  names = names.mid(std::max<qsizetype>(0, more));
  std::reverse(names.begin(), names.end());
  return names.join(QStringLiteral(", ")) + (more > 0 ? QStringLiteral("\u2026") : QString());
}

}  // namespace

QString describe(const Unsaved& unsaved) {
  QStringList lines;
  if (!unsaved.edits.isEmpty())
    lines << QObject::tr("%1 since the last save: %2.")
                 .arg(unsaved.edits.size() == 1 ? QObject::tr("1 edit")
                                                : QObject::tr("%1 edits").arg(unsaved.edits.size()),
                      listed(unsaved.edits));
  if (unsaved.bakedSeconds > 0)
    lines << QObject::tr("It has been baked for %1, and that is in no file yet.")
                 .arg(formatSeconds(unsaved.bakedSeconds));
  if (unsaved.bakeGoesOn)
    lines << QObject::tr(
        "What is baked so far stays beside the project either way and goes on the next time.");
  return lines.join(u'\n');
}

DocumentMenu::DocumentMenu(Session& session, QMainWindow& window)
    : QObject(&window), session_(session), window_(window) {
  session_.project().setQuestion([this](const Unsaved& unsaved) { return ask(unsaved); });
}

DocumentMenu::~DocumentMenu() {
  session_.project().setQuestion({});
}

void DocumentMenu::fillFile(QMenu* menu) {
  QMenu* fresh = menu->addMenu(icon(QStringLiteral("document-new")), tr("&New"));
  add(fresh, "document-new", tr("&Default scene"), QKeySequence::New,
      [this] { session_.openDefaultScene(); });
  add(fresh, "document-new", tr("&Empty stage"), {},
      [this] { session_.open(QStringLiteral("builtin:ground")); });
  add(menu, "document-open", tr("&Open\u2026"), QKeySequence::Open, [this] { openFile(); });
  recent_ = menu->addMenu(icon(QStringLiteral("document-open-recent")), tr("Open &recent"));
  recent_->setObjectName(QStringLiteral("recentFiles"));
  recent_->setToolTipsVisible(true);
  connect(recent_, &QMenu::aboutToShow, this, &DocumentMenu::fillRecent);
  QMenu* samples = menu->addMenu(tr("S&amples"));
  for (const QString& name : session_.sampleScenes())
    samples->addAction(name, this, [this, name] { session_.open(QStringLiteral("scene:") + name); });
  menu->addSeparator();
  add(menu, "document-save", tr("&Save project"), QKeySequence::Save, [this] { saveProject(false); });
  add(menu, "document-save-as", tr("Save project &as\u2026"), QKeySequence::SaveAs,
      [this] { saveProject(true); });
  backups_ = menu->addMenu(tr("&Earlier saves"));
  connect(backups_, &QMenu::aboutToShow, this, &DocumentMenu::fillBackups);
  menu->addSeparator();
  QAction* missing = menu->addAction(tr("&Locate missing files\u2026"), this, &DocumentMenu::relink);
  QAction* collect = menu->addAction(tr("&Collect project"), this, [this] { session_.project().collect(); });
  collect->setToolTip(tr("Copies every file that the project uses into a folder beside it."));
  connect(menu, &QMenu::aboutToShow, this, [this, missing, collect] {
    missing->setEnabled(!session_.project().brokenLinks().empty());
    collect->setEnabled(!session_.document().path().isEmpty());
  });
  menu->addSeparator();
  add(menu, "application-exit", tr("&Quit"), QKeySequence::Quit, [this] { window_.close(); });
}

void DocumentMenu::fillRecent() {
  recent_->clear();
  RecentFiles& recent = session_.project().recent();
  bool missing = false;
  for (const QString& file : recent.files()) {
    const bool there = RecentFiles::exists(file);
    QAction* action =
        recent_->addAction(QFileInfo(file).fileName() + (there ? QString() : tr(" \u2014 missing")));
    action->setToolTip(file);
    action->setEnabled(there);
    missing = missing || !there;
    connect(action, &QAction::triggered, this, [this, file] { session_.open(file); });
  }
  if (recent_->isEmpty()) recent_->addAction(tr("Nothing was opened yet"))->setEnabled(false);
  recent_->addSeparator();
  QAction* remove =
      recent_->addAction(tr("&Remove missing files"), this, [&recent] { recent.removeMissing(); });
  remove->setEnabled(missing);
  recent_->addAction(tr("&Clear list"), this, [&recent] { recent.clear(); })
      ->setEnabled(!recent.files().isEmpty());
}

void DocumentMenu::fillBackups() {
  backups_->clear();
  const QString path = session_.document().path();
  const auto files = path.isEmpty() ? std::vector<std::filesystem::path>{} : backupsOf(path.toStdString());
  for (const auto& each : files) {
    const QFileInfo file(QString::fromStdString(each.string()));
    backups_->addAction(tr("Saved %1").arg(QLocale().toString(file.lastModified(), QLocale::ShortFormat)),
                        this, [this, file] { session_.open(file.filePath()); });
  }
  if (files.empty()) backups_->addAction(tr("None yet"))->setEnabled(false);
  backups_->addSeparator();
  QMenu* count = backups_->addMenu(tr("Keep the last"));
  auto* group = new QActionGroup(count);
  for (const int n : {0, 1, 3, 10}) {
    QAction* action = count->addAction(n == 0 ? tr("None") : QString::number(n), this,
                                       [n] { ProjectKeeper::setBackups(n); });
    action->setCheckable(true);
    action->setChecked(n == ProjectKeeper::backups());
    group->addAction(action);
  }
}

void DocumentMenu::fillHistory(QMenu* edit) {
  history_ = edit->addMenu(tr("&History"));
  history_->setObjectName(QStringLiteral("history"));
  connect(history_, &QMenu::aboutToShow, this, &DocumentMenu::fillSteps);
}

// From what could be done again, over now, back to the beginning.
void DocumentMenu::fillSteps() {
  history_->clear();
  Document& document = session_.document();
  const QStringList ahead = document.redoNames(), behind = document.undoNames();
  for (int i = int(std::min<qsizetype>(ahead.size(), kListed)); i > 0; --i)
    history_->addAction(icon(QStringLiteral("edit-redo")), ahead[i - 1], this,
                        [&document, i] { document.step(i); });
  QAction* now = history_->addAction(tr("Now"));
  now->setEnabled(false);
  for (int i = 1; i <= int(std::min<qsizetype>(behind.size(), kListed)); ++i)
    history_->addAction(icon(QStringLiteral("edit-undo")), behind[behind.size() - i], this,
                        [&document, i] { document.step(-i); });
}

void DocumentMenu::openFile() {
  const QString file = QFileDialog::getOpenFileName(
      &window_, tr("Open"), QFileInfo(session_.document().path()).path(),
      tr("Everything (*.prt *.json *.obj *.ply *.off *.stl *.gltf *.glb *.hdr *.exr *.png);;Projects "
         "(*.prt);;"
         "Meshes (*.obj *.ply *.off *.stl *.gltf *.glb);;Environments (*.hdr *.exr *.png);;All files (*)"));
  if (!file.isEmpty()) session_.open(file);
}

void DocumentMenu::saveProject(bool askForName) {
  QString file = session_.document().path();
  if (askForName || file.isEmpty()) file = askForFile();
  if (!file.isEmpty()) session_.save(file);
}

QString DocumentMenu::askForFile() {
  QString file = session_.document().path();
  file = QFileDialog::getSaveFileName(&window_, tr("Save project"), file, tr("Projects (*.prt)"));
  if (!file.isEmpty() && !file.endsWith(u".prt")) file += QStringLiteral(".prt");
  return file;
}

LeaveAnswer DocumentMenu::ask(const Unsaved& unsaved) {
  QMessageBox box(&window_);
  box.setObjectName(QStringLiteral("leaveQuestion"));
  box.setWindowTitle(tr("Unsaved work"));
  box.setText(
      tr("Save %1 before it is closed?").arg(unsaved.title.isEmpty() ? tr("the scene") : unsaved.title));
  box.setInformativeText(describe(unsaved));
  QPushButton* save = box.addButton(tr("&Save"), QMessageBox::AcceptRole);
  QPushButton* discard = box.addButton(tr("&Don't save"), QMessageBox::DestructiveRole);
  box.addButton(QMessageBox::Cancel);
  box.setDefaultButton(save);
  box.exec();
  if (box.clickedButton() == discard) return {Leave::Discard, {}};
  if (box.clickedButton() != save) return {Leave::Cancel, {}};
  QString file = session_.document().path();
  if (file.isEmpty()) file = askForFile();
  return file.isEmpty() ? LeaveAnswer{} : LeaveAnswer{Leave::Save, file};
}

void DocumentMenu::relink() {
  auto* dialog = new RelinkDialog(session_.project(), &window_);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->show();
}

}  // namespace prt::ui
