// Rays that take many steps, on devices that do not let them.
//
// Mesa's software rasterisers end every loop of a shader, without a word, after 65,535 rounds in
// all loops together of the eight or sixteen invocations that run as one. There, programs are
// compiled with ENCORE_PAUSE_AFTER: a ray that has spent that many rounds gives up, and the host
// sends what is left to a second program, compiled with ENCORE_RESUMABLE too, in which such rays
// begin again and store where they stand each time they pause, until no ray is left. Nearly all
// pictures need the first program only, which is fast as it stores nothing. All other devices run
// every ray to its end at once, and nothing of this is compiled in.
//
// Every loop of unknown length spends a round each time round, and traversals offer to pause where
// their state is small. What they may go on for in between (the depth of a tree, a row of cells) is
// far less than the limit has to spare.
#ifdef ENCORE_PAUSE_AFTER
int rounds_left = ENCORE_PAUSE_AFTER;
#define ENCORE_SPEND --rounds_left
#define ENCORE_PAUSE_IF_SPENT \
  if (rounds_left <= 0) return false
#else
#define ENCORE_SPEND
#define ENCORE_PAUSE_IF_SPENT
#endif
