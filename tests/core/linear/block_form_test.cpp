// Block forms of A are kept for the whole process. Each thread must get the form of its own matrix.
#include "core/linear/block_form.h"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

#include "irk/misuse.h"
#include "irk/tableaus.h"

namespace irk {
namespace {

double distance(const BlockForm<double>& form, const Mat<double>& A) {
  return (form.from_basis.transpose() * form.T * form.to_basis.transpose() - A).cwiseAbs().maxCoeff();
}

TEST(BlockForm, IsThatOfItsMatrixEachTime) {
  for (int round = 0; round < 2; ++round) {
    for (const char* id : {"radau_iia_3", "gauss_3", "radau_ia_3", "radau_iia_8", "gauss_8"}) {
      const Mat<double> A = makeTableau<double>(id).A;
      EXPECT_LT(distance(*schurForm(A), A), 1e-14) << id;
      EXPECT_LT(distance(*eigenForm(A), A), 1e-11) << id;
      for (const auto& form : {schurForm(A), eigenForm(A)}) EXPECT_EQ(form->T2, form->T * form->T) << id;
      EXPECT_TRUE(eigenForm(A)->diagonal) << id;
      EXPECT_FALSE(schurForm(A)->diagonal) << id;
      const Mat<double> other = A * 0.5;  // of the same size
      EXPECT_LT(distance(*schurForm(other), other), 1e-14) << id;
    }
  }
}

TEST(BlockForm, ADefectiveMatrixIsRefusedEachTime) {
  Mat<double> A(2, 2);
  A << 1, 1, 0, 1;
  for (int round = 0; round < 2; ++round) EXPECT_THROW(eigenForm(A), Misuse);
}

TEST(BlockForm, ThreadsShareThem) {
  std::vector<std::thread> threads;
  std::vector<double> worst(4, 0);
  for (std::size_t t = 0; t < worst.size(); ++t) {
    threads.emplace_back([&worst, t] {
      for (int i = 0; i < 700; ++i) {  // more than are kept
        const Mat<double> A = makeTableau<double>("radau_iia_3").A * (1 + 1e-3 * i);
        worst[t] = std::max(worst[t], distance(*schurForm(A), A));
      }
    });
  }
  for (auto& thread : threads) thread.join();
  for (const double one : worst) EXPECT_LT(one, 1e-14);
}

}  // namespace
}  // namespace irk
