// The processes of one campaign: those that mpirun or srun started, or this one alone. Needs no MPI where it is alone.
#pragma once

#include <cstdint>
#include <vector>

namespace studies {

class Crew {
 public:
  Crew();  // MPI's own errors end the program
  ~Crew();
  Crew(const Crew&) = delete;
  Crew& operator=(const Crew&) = delete;

  int rank() const { return rank_; }
  int size() const { return size_; }
  bool leads() const { return rank_ == 0; }

  // 0, 1, 2, ...: each number to one process. Of a counter in the leader's memory that the others add to by themselves.
  std::uint64_t next();
  // From now on next() gives no number below `end` to anybody.
  void skip_to(std::uint64_t end);
  // To be called now and then by the leader: without remote memory access in hardware the others wait for it.
  void help();

  // Of all processes together: each must call them.
  void wait();
  bool any(bool mine);
  std::vector<std::uint64_t> from_leader(std::vector<std::uint64_t> values);

 private:
  struct Counter;
  Counter* counter_ = nullptr;  // none: alone
  std::uint64_t next_alone_ = 0;
  int rank_ = 0, size_ = 1;
};

}  // namespace studies
