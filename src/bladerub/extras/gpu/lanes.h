// The 32 lanes of a warp as values: `real`, `flag` and `integer` have one number in each lane.
//
// On a GPU they are numbers, and every thread of the warp holds its own. Elsewhere they are arrays of 32, so
// that the same kernel runs, a warp at a time, on any processor. All branches of the kernel depend on `all`
// or `any`: the lanes go the same way.

#define ALL_THREADS 0xffffffffu
constexpr int LANES = 32;

#ifdef __CUDACC__

#define HERE __device__ __forceinline__
#ifndef INFINITY
#define INFINITY __longlong_as_double(0x7ff0000000000000)
#endif
using real = double;
using flag = bool;
using integer = int;

HERE integer lane() { return threadIdx.x & 31; }
HERE real where(flag chosen, real a, real b) { return chosen ? a : b; }
HERE real minimum(real a, real b) { return a < b ? a : b; }
HERE real maximum(real a, real b) { return a > b ? a : b; }
HERE real absolute(real a) { return fabs(a); }
HERE integer floor_of(real a) { return (int)floor(a); }
HERE real real_of(integer a) { return (double)a; }
HERE integer choose(flag chosen, integer a, integer b) { return chosen ? a : b; }
// The number of the lane whose number differs from the own one in the bit `bit`
HERE real exchange(real a, int bit) { return __shfl_xor_sync(ALL_THREADS, a, bit); }
HERE bool all(flag a) { return __all_sync(ALL_THREADS, a); }
HERE bool any(flag a) { return __any_sync(ALL_THREADS, a); }
HERE void synchronise() { __syncwarp(); }
HERE real load(const double* from, integer at) { return from[at]; }
HERE void store(double* to, integer at, real value, flag where) {
  if (where) to[at] = value;
}

// Without the branches of the exact functions for numbers that are no normal ones; error of one unit in the
// last place at most
HERE real reciprocal(real a) {
  double y;
  asm("rcp.approx.ftz.f64 %0, %1;" : "=d"(y) : "d"(a));
  y = fma(y, fma(-a, y, 1.0), y);
  return fma(y, fma(-a, y, 1.0), y);
}
HERE real sqrt_of(real a) {
  double y;
  asm("rsqrt.approx.ftz.f64 %0, %1;" : "=d"(y) : "d"(a));
  double root = a * y, half = 0.5 * y, error = fma(-half, root, 0.5);
  root = fma(root, error, root);
  half = fma(half, error, half);
  error = fma(-half, root, 0.5);
  root = fma(root, error, root);
  half = fma(half, error, half);
  return fma(fma(-root, root, a), half, root);
}

#else

#include <cmath>

#define HERE static inline

template <class T>
struct Lanes {
  T of[LANES];
  Lanes() = default;
  Lanes(T a) {
    for (int i = 0; i < LANES; i++) of[i] = a;
  }
};
#ifndef REAL
#define REAL double
#endif
using real = Lanes<REAL>;
using flag = Lanes<bool>;
using integer = Lanes<int>;

#define BINARY(operation, result, kind)                                  \
  HERE result operator operation(const kind& a, const kind& b) {         \
    result c;                                                            \
    for (int i = 0; i < LANES; i++) c.of[i] = a.of[i] operation b.of[i]; \
    return c;                                                            \
  }
BINARY(+, real, real)
BINARY(-, real, real)
BINARY(*, real, real)
BINARY(/, real, real)
BINARY(<, flag, real)
BINARY(>, flag, real)
BINARY(<=, flag, real)
BINARY(>=, flag, real)
BINARY(&, flag, flag)
BINARY(|, flag, flag)
BINARY(+, integer, integer)
BINARY(-, integer, integer)
BINARY(*, integer, integer)
BINARY(&, integer, integer)
BINARY(^, integer, integer)
BINARY(>>, integer, integer)
BINARY(<, flag, integer)
BINARY(>=, flag, integer)
BINARY(==, flag, integer)
BINARY(!=, flag, integer)
HERE real& operator+=(real& a, const real& b) { return a = a + b; }
HERE real operator-(const real& a) { return real(0.0) - a; }

#define EACH(result, expression)                        \
  result c;                                             \
  for (int i = 0; i < LANES; i++) c.of[i] = expression; \
  return c;
HERE integer lane(){EACH(integer, i)} HERE real where(const flag& chosen, const real& a, const real& b){
    EACH(real, chosen.of[i] ? a.of[i] : b.of[i])} HERE real
    minimum(const real& a, const real& b){EACH(real, a.of[i] < b.of[i] ? a.of[i] : b.of[i])} HERE real
    maximum(const real& a, const real& b){EACH(real, a.of[i] > b.of[i] ? a.of[i] : b.of[i])} HERE real
    absolute(const real& a){EACH(real, std::fabs(a.of[i]))} HERE integer
    floor_of(const real& a){EACH(integer, (int)std::floor(a.of[i]))} HERE real
    real_of(const integer& a){EACH(real, (double)a.of[i])} HERE integer
    choose(const flag& chosen, const integer& a,
           const integer& b){EACH(integer, chosen.of[i] ? a.of[i] : b.of[i])} HERE real
    exchange(const real& a, int bit){EACH(real, a.of[i ^ bit])} HERE bool all(const flag& a) {
  bool c = true;
  for (int i = 0; i < LANES; i++) c = c && a.of[i];
  return c;
}
HERE bool any(const flag& a) {
  bool c = false;
  for (int i = 0; i < LANES; i++) c = c || a.of[i];
  return c;
}
HERE void synchronise() {}
HERE real load(const double* from, const integer& at){EACH(real, from[at.of[i]])} HERE
    void store(double* to, const integer& at, const real& value, const flag& where) {
  for (int i = 0; i < LANES; i++)
    if (where.of[i]) to[at.of[i]] = value.of[i];
}
HERE real reciprocal(const real& a){EACH(real, 1.0 / a.of[i])} HERE real sqrt_of(const real& a) {
  EACH(real, std::sqrt(a.of[i]))
}

#endif

// What a formula written in Python returns two of
struct Pair {
  real first, second;
};

// Sum over all lanes, in every lane
HERE real total(real a) {
  for (int bit = 16; bit; bit >>= 1) a += exchange(a, bit);
  return a;
}
