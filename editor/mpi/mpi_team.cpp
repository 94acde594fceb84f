#include "mpi/mpi_team.h"

#include <fmt/format.h>
#include <mpi.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <ctime>

namespace slipface {
namespace {

// MPI counts bytes with an int, over all ranks.
constexpr std::size_t max_bytes_at_once = std::size_t{1} << 30;

double thread_seconds() {
    timespec time{};
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace

// MPI's own error handler ends the job on any error, so no call's result needs a check.
MpiTeam::MpiTeam() {
    int rank = 0, size = 1, length = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    rank_ = static_cast<std::size_t>(rank);
    size_ = static_cast<std::size_t>(size);
    std::array<char, MPI_MAX_PROCESSOR_NAME> name{};
    MPI_Get_processor_name(name.data(), &length);
    hosts_ = gather(std::string(name.data(), static_cast<std::size_t>(length)));
    traffic_ = {};
}

std::string MpiTeam::name_of(std::size_t rank) const {
    return fmt::format("rank {} on {}", rank, hosts_[rank]);
}

std::vector<std::string> MpiTeam::gather(const std::string& mine) {
    const double begin = MPI_Wtime(), processor_begin = thread_seconds();
    const std::uint64_t size = mine.size();
    std::vector<std::uint64_t> sizes(size_);
    MPI_Allgather(&size, 1, MPI_UINT64_T, sizes.data(), 1, MPI_UINT64_T, MPI_COMM_WORLD);
    const std::uint64_t largest = *std::max_element(sizes.begin(), sizes.end());
    const std::uint64_t piece = max_bytes_at_once / size_;  // of each rank at a time
    std::vector<std::string> all(size_);
    std::vector<int> counts(size_), begins(size_);
    std::string buffer;
    for (std::uint64_t from = 0; from < largest; from += piece) {
        const auto count_of = [&](std::uint64_t bytes) {
            return static_cast<int>(std::min(piece, bytes - std::min(bytes, from)));
        };
        int total = 0;
        for (std::size_t rank = 0; rank < size_; ++rank) {
            counts[rank] = count_of(sizes[rank]);
            begins[rank] = total;
            total += counts[rank];
        }
        buffer.resize(static_cast<std::size_t>(total));
        MPI_Allgatherv(mine.data() + std::min(size, from), count_of(size), MPI_BYTE, buffer.data(),
                       counts.data(), begins.data(), MPI_BYTE, MPI_COMM_WORLD);
        for (std::size_t rank = 0; rank < size_; ++rank)
            all[rank].append(buffer, static_cast<std::size_t>(begins[rank]),
                             static_cast<std::size_t>(counts[rank]));
    }
    ++traffic_.calls;
    traffic_.sent += size;
    for (const std::uint64_t bytes : sizes)
        traffic_.received += bytes;
    traffic_.seconds += MPI_Wtime() - begin;
    traffic_.processor_s += thread_seconds() - processor_begin;
    return all;
}

std::string MpiTeam::from_first(const std::string& bytes) {
    std::uint64_t size = bytes.size();
    MPI_Bcast(&size, 1, MPI_UINT64_T, 0, MPI_COMM_WORLD);
    std::string all = rank_ == 0 ? bytes : std::string(static_cast<std::size_t>(size), '\0');
    for (std::size_t from = 0; from < size; from += max_bytes_at_once)
        MPI_Bcast(all.data() + from, static_cast<int>(std::min<std::size_t>(max_bytes_at_once, size - from)),
                  MPI_BYTE, 0, MPI_COMM_WORLD);
    return all;
}

void MpiTeam::stop(const std::string& why) {
    fmt::print(stderr, "slipface-mpi: {}\n", why);
    MPI_Abort(MPI_COMM_WORLD, 2);
    std::abort();
}

}  // namespace slipface
