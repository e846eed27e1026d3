#include "studies/engine/crew.h"

#include <algorithm>
#include <cstdlib>

#define OMPI_SKIP_MPICXX
#include <mpi.h>

namespace studies {

struct Crew::Counter {
  MPI_Win window;
  std::uint64_t* value;  // the leader's

  std::uint64_t change(std::uint64_t by, MPI_Op how) {
    std::uint64_t before = 0;
    MPI_Fetch_and_op(&by, &before, MPI_UINT64_T, 0, 0, how, window);
    MPI_Win_flush(0, window);
    return before;
  }
};

namespace {

// What Open MPI, MPICH and Slurm's starters leave in the environment.
bool started_by_mpi() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK", "PMI_SIZE"}) {
    if (std::getenv(name) != nullptr) return true;
  }
  return false;
}

}  // namespace

Crew::Crew() {
  if (!started_by_mpi()) return;
  MPI_Init(nullptr, nullptr);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &size_);
  counter_ = new Counter;
  MPI_Win_allocate(leads() ? sizeof(std::uint64_t) : 0, sizeof(std::uint64_t), MPI_INFO_NULL, MPI_COMM_WORLD,
                   &counter_->value, &counter_->window);
  MPI_Win_lock_all(0, counter_->window);
  if (leads()) counter_->change(0, MPI_REPLACE);
  wait();
}

Crew::~Crew() {
  if (counter_ == nullptr) return;
  MPI_Win_unlock_all(counter_->window);
  MPI_Win_free(&counter_->window);
  delete counter_;
  MPI_Finalize();
}

std::uint64_t Crew::next() {
  return counter_ == nullptr ? next_alone_++ : counter_->change(1, MPI_SUM);
}

void Crew::skip_to(std::uint64_t end) {
  if (counter_ == nullptr) next_alone_ = std::max(next_alone_, end);
  else counter_->change(end, MPI_MAX);
}

void Crew::help() {
  int waiting = 0;
  if (counter_ != nullptr && size_ > 1)
    MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &waiting, MPI_STATUS_IGNORE);
}

void Crew::wait() {
  if (counter_ != nullptr) MPI_Barrier(MPI_COMM_WORLD);
}

bool Crew::any(bool mine) {
  int value = mine;
  if (counter_ != nullptr) MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_INT, MPI_LOR, MPI_COMM_WORLD);
  return value != 0;
}

std::vector<std::uint64_t> Crew::from_leader(std::vector<std::uint64_t> values) {
  if (counter_ == nullptr) return values;
  std::uint64_t count = values.size();
  MPI_Bcast(&count, 1, MPI_UINT64_T, 0, MPI_COMM_WORLD);
  values.resize(count);
  MPI_Bcast(values.data(), static_cast<int>(count), MPI_UINT64_T, 0, MPI_COMM_WORLD);
  return values;
}

}  // namespace studies
