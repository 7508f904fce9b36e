//! Arrays of three.

/// Returns `[value(0), value(1), value(2)]`.
///
/// Unlike `array::map` this is always inlined. A call would pass the array through memory and read it
/// back in pieces of other sizes than were written, which stalls the processor.
#[inline(always)]
pub(super) fn three<T>(value: impl Fn(usize) -> T) -> [T; 3] {
    [value(0), value(1), value(2)]
}
