//! Lists that are read in no order. They lie in large pages of memory where the system has them: the
//! processor then keeps at hand where all of them are. Embree does the same.

use memmap2::MmapMut;
use std::marker::PhantomData;
use std::ops::{Deref, DerefMut};

/// The smallest page: memory begins at a multiple of it.
const PAGE: usize = 4096;

/// A list with room for so many and no more. What is not used of the room takes no memory.
pub(super) struct Pages<T> {
    memory: MmapMut,
    count: usize,
    kind: PhantomData<T>,
}

impl<T: Copy> Pages<T> {
    /// # Panics
    /// If there is no such memory.
    pub(super) fn with_room(most: usize) -> Self {
        const { assert!(align_of::<T>() <= PAGE) };
        let bytes = most.checked_mul(size_of::<T>()).expect("too many");
        let memory = MmapMut::map_anon(bytes.max(1)).expect("memory for a tree");
        // A wish: in small pages all is the same but slower.
        #[cfg(target_os = "linux")]
        let _ = memory.advise(memmap2::Advice::HugePage);
        Pages {
            memory,
            count: 0,
            kind: PhantomData,
        }
    }

    /// # Panics
    /// If there is no room.
    pub(super) fn push(&mut self, value: T) {
        let room = self.memory.len() / size_of::<T>();
        assert!(self.count < room, "room for {room}");
        // SAFETY: there is room for one more, and memory is aligned.
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
        // SAFETY: so many were written there, and memory is aligned.
        unsafe { std::slice::from_raw_parts(self.memory.as_ptr().cast(), self.count) }
    }
}

impl<T> DerefMut for Pages<T> {
    fn deref_mut(&mut self) -> &mut [T] {
        // SAFETY: likewise.
        unsafe { std::slice::from_raw_parts_mut(self.memory.as_mut_ptr().cast(), self.count) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn holds_what_was_put_there() {
        let mut pages = Pages::with_room(5000);
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
    #[should_panic(expected = "room for")]
    fn does_not_write_beyond_its_room() {
        let mut pages = Pages::with_room(PAGE / 4);
        (0..=PAGE / 4).for_each(|k| pages.push(k as u32));
    }

    #[test]
    fn no_room_is_an_empty_list() {
        assert_eq!(Pages::<u64>::with_room(0).len(), 0);
    }
}
