// SPDX-License-Identifier: BSD-3-Clause
#include "steps.hpp"

#include <vtkAlgorithm.h>
#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkNew.h>

namespace kappa::view_detail {
namespace {

/// What a filter that runs tells about.
struct Listener {
  const Execution& run;
  Reporter reporter;
};

void on_progress(vtkObject* caller, unsigned long, void* data, void*) {
  auto& listener = *static_cast<Listener*>(data);
  auto* const filter = vtkAlgorithm::SafeDownCast(caller);
  if (listener.run.cancel != nullptr && listener.run.cancel->load()) {
    filter->AbortExecuteOn();
  } else {
    listener.reporter.report(std::clamp(filter->GetProgress(), 0.0, 1.0));
  }
}

}  // namespace

void Reporter::report(double done) {
  if (!run_.progress) return;
  const auto now = std::chrono::steady_clock::now();
  if (now - last_ < std::chrono::milliseconds(100)) return;
  last_ = now;
  run_.progress(done);
}

void update(vtkAlgorithm* filter, const Execution& run) {
  check_cancelled(run);
  Listener listener{run, Reporter(run)};
  vtkNew<vtkCallbackCommand> observer;
  observer->SetCallback(on_progress);
  observer->SetClientData(&listener);
  const unsigned long tag = filter->AddObserver(vtkCommand::ProgressEvent, observer);
  filter->Update();
  filter->RemoveObserver(tag);
  check_cancelled(run);
  if (run.progress) run.progress(1.0);
}

}  // namespace kappa::view_detail
