#pragma once
// Where functions must not become too large.

// Engines of WebAssembly allocate registers badly in functions of more than some thousand values, and inline nothing
// themselves: what is marked so stays a function of its own there. Elsewhere compilers know better.
#if defined(TUTTE_COMPACT)
#define TUTTE_APART [[gnu::noinline]]
#else
#define TUTTE_APART
#endif
