#pragma once
// Tables that integer recurrences make. Mostly the compiler makes them; where a program's size counts more than a
// moment of its time, in WebAssembly, the program makes them when it starts (TUTTE_COMPACT). The numbers are
// the same.
//
//   TUTTE_TABLE std::array<uint16_t, 100> kSquares = madeTable([] { ... return table; });

namespace tutte {

#if defined(TUTTE_COMPACT)
#define TUTTE_TABLE inline const
template <class Make>
auto madeTable(Make make) {  // not constexpr: so nothing of it happens before the program runs
  return make();
}
#else
#define TUTTE_TABLE inline constexpr
template <class Make>
constexpr auto madeTable(Make make) {
  return make();
}
#endif

}  // namespace tutte
