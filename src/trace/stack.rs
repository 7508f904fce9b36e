//! The numbers that a traversal computes with, and its stack.

/// Memory that traversals reuse from ray to ray.
#[derive(Debug, Default)]
pub struct Scratch {
    stack_f32: Vec<StackEntry<f32>>,
    stack_f64: Vec<StackEntry<f64>>,
}

/// A far child that is pending, and the interval of the ray within its cell.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StackEntry<T> {
    pub(super) node: u32,
    pub(super) t_enter: T,
    pub(super) t_exit: T,
}

/// The number type of a traversal: `f32` or `f64`.
pub(crate) trait Real: Copy + PartialOrd {
    fn from_f64(value: f64) -> Self;
    fn to_f64(self) -> f64;
    fn min(self, other: Self) -> Self;
    fn max(self, other: Self) -> Self;
    /// Returns the stack of traversals in this type.
    fn stack(scratch: &mut Scratch) -> &mut Vec<StackEntry<Self>>;
}

macro_rules! real {
    ($real:ident, $stack:ident) => {
        impl Real for $real {
            #[inline(always)]
            fn from_f64(value: f64) -> Self {
                value as $real
            }
            #[inline(always)]
            fn to_f64(self) -> f64 {
                f64::from(self)
            }
            #[inline(always)]
            fn min(self, other: Self) -> Self {
                $real::min(self, other)
            }
            #[inline(always)]
            fn max(self, other: Self) -> Self {
                $real::max(self, other)
            }
            #[inline(always)]
            fn stack(scratch: &mut Scratch) -> &mut Vec<StackEntry<Self>> {
                &mut scratch.$stack
            }
        }
    };
}
real!(f32, stack_f32);
real!(f64, stack_f64);
