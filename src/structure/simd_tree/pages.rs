//! Arrays for random access, in huge pages where the system has them: fewer pages cause fewer TLB
//! misses. Embree does the same.

use memmap2::MmapMut;
use std::marker::PhantomData;
use std::ops::{Deref, DerefMut};

/// The smallest page size: memory starts at a multiple of it.
const PAGE: usize = 4096;

/// An array of fixed capacity. Unused capacity takes no memory.
pub(crate) struct Pages<T> {
    memory: MmapMut,
    count: usize,
    kind: PhantomData<T>,
}

impl<T: Copy> Pages<T> {
    /// # Panics
    /// If the memory cannot be mapped.
    pub(crate) fn with_capacity(capacity: usize) -> Self {
        const { assert!(align_of::<T>() <= PAGE) };
        let bytes = capacity.checked_mul(size_of::<T>()).expect("too many");
        let memory = MmapMut::map_anon(bytes.max(1)).expect("memory for a tree");
        // A hint that may fail: in small pages everything works, but slower.
        #[cfg(target_os = "linux")]
        let _ = memory.advise(memmap2::Advice::HugePage);
        Pages {
            memory,
            count: 0,
            kind: PhantomData,
        }
    }

    /// # Panics
    /// If the array is full.
    pub(crate) fn push(&mut self, value: T) {
        let capacity = self.memory.len() / size_of::<T>();
        assert!(self.count < capacity, "capacity of {capacity} exceeded");
        // SAFETY: there is capacity for one more, and memory is aligned.
        unsafe {
            self.memory
                .as_mut_ptr()
                .cast::<T>()
                .add(self.count)
                .write(value)
        };
        self.count += 1;
    }
}

impl<T> Deref for Pages<T> {
    type Target = [T];

    #[inline(always)]
    fn deref(&self) -> &[T] {
        // SAFETY: `count` values were written there, and memory is aligned.
        unsafe { std::slice::from_raw_parts(self.memory.as_ptr().cast(), self.count) }
    }
}

impl<T> DerefMut for Pages<T> {
    fn deref_mut(&mut self) -> &mut [T] {
        // SAFETY: as above.
        unsafe { std::slice::from_raw_parts_mut(self.memory.as_mut_ptr().cast(), self.count) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn holds_the_values_pushed() {
        let mut pages = Pages::with_capacity(5000);
        assert!(pages.is_empty());
        (0..4000_u32).for_each(|k| pages.push([k, k + 1]));
        pages[7] = [0, 0];
        assert_eq!(pages.len(), 4000);
        assert_eq!(
            [pages[6], pages[7], pages[3999]],
            [[6, 7], [0, 0], [3999, 4000]]
        );
    }

    #[test]
    #[should_panic(expected = "capacity of")]
    fn does_not_write_beyond_its_capacity() {
        let mut pages = Pages::with_capacity(PAGE / 4);
        (0..=PAGE / 4).for_each(|k| pages.push(k as u32));
    }

    #[test]
    fn no_capacity_is_an_empty_array() {
        assert_eq!(Pages::<u64>::with_capacity(0).len(), 0);
    }
}
