#include "math/expansion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <utility>

#include "math/whole_number.h"

namespace pdc::detail {
namespace {

/// Numbers of all sizes, many with few bits, so that parts vanish too.
class RandomNumbers {
 public:
  double next() {
    const int bits = std::uniform_int_distribution<int>(1, 53)(mEngine);
    const auto mantissa = static_cast<double>(std::uniform_int_distribution<std::int64_t>(
        -(std::int64_t{1} << bits) + 1, (std::int64_t{1} << bits) - 1)(mEngine));
    return std::ldexp(mantissa, std::uniform_int_distribution<int>(-60, 20)(mEngine));
  }
  Expansion<2> difference() { return detail::difference(next(), next()); }

 private:
  std::mt19937_64 mEngine{3};
};

template <std::size_t kN>
Integer whole(const Expansion<kN>& e) {
  Integer sum = 0;
  for (std::size_t i = 0; i < e.size; ++i) sum += pdc::whole(e.parts[i]);
  return sum;
}

double lowestBit(double x) {
  const Integer w = abs(pdc::whole(x));
  return std::ldexp(1.0, static_cast<int>(lsb(w)) - kWholeBits);
}

int significantBits(double x) {
  const Integer w = abs(pdc::whole(x));
  return w == 0 ? 0 : static_cast<int>(msb(w) - lsb(w)) + 1;
}

/// Expects the parts to have the exact sum `expected`, to be ordered, and to share no bits.
template <std::size_t kN>
void expectExact(const Expansion<kN>& e, const Integer& expected) {
  ASSERT_LE(e.size, kN);
  ASSERT_EQ(whole(e), expected);
  ASSERT_EQ(e.sign(), signOf(expected));
  for (std::size_t i = 0; i < e.size; ++i) {
    ASSERT_NE(e.parts[i], 0);
    ASSERT_TRUE(i == 0 || std::abs(e.parts[i - 1]) < lowestBit(e.parts[i]));
  }
}

TEST(Expansion, SumsAndProductsOfTwoNumbersKeepWhatRoundingTakesAway) {
  RandomNumbers random;
  int rounded = 0;
  for (int i = 0; i < 10'000; ++i) {
    double a = random.next(), b = random.next();
    const Rounded sum = twoSum(a, b), product = twoProduct(a, b), halves = split(a);
    ASSERT_EQ(sum.value, a + b);
    ASSERT_EQ(pdc::whole(sum.value) + pdc::whole(sum.rest), pdc::whole(a) + pdc::whole(b));
    ASSERT_EQ(product.value, a * b);
    ASSERT_EQ((pdc::whole(product.value) + pdc::whole(product.rest)) << kWholeBits, pdc::whole(a) * pdc::whole(b));
    ASSERT_EQ(halves.value + halves.rest, a);
    ASSERT_LE(significantBits(halves.value), 26);
    ASSERT_LE(significantBits(halves.rest), 26);
    if (std::abs(a) < std::abs(b)) std::swap(a, b);
    ASSERT_EQ(fastTwoSum(a, b).value, sum.value);
    ASSERT_EQ(fastTwoSum(a, b).rest, sum.rest);
    rounded += sum.rest != 0 && product.rest != 0;
  }
  EXPECT_GT(rounded, 1000);
}

TEST(Expansion, OperationsAreExact) {
  RandomNumbers random;
  std::size_t longest = 0;
  for (int i = 0; i < 10'000; ++i) {
    const double a = random.next(), b = random.next();
    ASSERT_NO_FATAL_FAILURE(expectExact(difference(a, b), pdc::whole(a) - pdc::whole(b)));
    const Expansion<2> u = random.difference(), v = random.difference(), w = random.difference();
    ASSERT_NO_FATAL_FAILURE(expectExact(negated(u), -whole(u)));
    const Expansion<4> s = sum(u, v);
    ASSERT_NO_FATAL_FAILURE(expectExact(s, whole(u) + whole(v)));
    ASSERT_NO_FATAL_FAILURE(expectExact(scaled(s, a), (whole(s) * pdc::whole(a)) >> kWholeBits));
    const Expansion<16> p = product(s, w);
    ASSERT_NO_FATAL_FAILURE(expectExact(p, (whole(s) * whole(w)) >> kWholeBits));
    ASSERT_NO_FATAL_FAILURE(expectExact(sum(p, negated(p)), 0));
    longest = std::max(longest, p.size);
  }
  EXPECT_GT(longest, 6U);
}

TEST(Expansion, OfZeroHasNoParts) {
  const Expansion<2> zero = difference(0.1, 0.1), one = difference(1, 0);
  EXPECT_EQ(zero.size, 0U);
  EXPECT_EQ(zero.sign(), 0);
  EXPECT_EQ(sum(zero, zero).size, 0U);
  EXPECT_EQ(scaled(zero, 3).size, 0U);
  EXPECT_EQ(product(one, zero).size, 0U);
  EXPECT_EQ(product(zero, one).size, 0U);
  EXPECT_EQ(sum(zero, one).sign(), 1);
  EXPECT_EQ(negated(one).sign(), -1);
}

}  // namespace
}  // namespace pdc::detail
