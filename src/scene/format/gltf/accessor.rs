//! Accessors: views of numbers in buffers, checked before anything is read.

use super::json::{Root, Whole};
use crate::geometry::Vec3;
use crate::scene::format::error::ReadError;
use crate::scene::format::place::Place;
use std::borrow::Cow;

/// The type of a component.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Component {
    I8,
    U8,
    I16,
    U16,
    U32,
    F32,
}

impl Component {
    fn named(number: Whole) -> Option<Self> {
        Some(match number.0 {
            5120 => Component::I8,
            5121 => Component::U8,
            5122 => Component::I16,
            5123 => Component::U16,
            5125 => Component::U32,
            5126 => Component::F32,
            _ => return None,
        })
    }

    fn size(self) -> usize {
        match self {
            Component::I8 | Component::U8 => 1,
            Component::I16 | Component::U16 => 2,
            Component::U32 | Component::F32 => 4,
        }
    }

    /// Returns the largest number, which stands for 1 if components are normalized.
    fn largest(self) -> f64 {
        match self {
            Component::I8 => f64::from(i8::MAX),
            Component::U8 => f64::from(u8::MAX),
            Component::I16 => f64::from(i16::MAX),
            Component::U16 => f64::from(u16::MAX),
            Component::U32 | Component::F32 => 1.0,
        }
    }

    /// Returns the number at the start of some bytes.
    fn number(self, bytes: &[u8]) -> f64 {
        let two = || [bytes[0], bytes[1]];
        let four = || [bytes[0], bytes[1], bytes[2], bytes[3]];
        match self {
            Component::I8 => f64::from(bytes[0] as i8),
            Component::U8 => f64::from(bytes[0]),
            Component::I16 => f64::from(i16::from_le_bytes(two())),
            Component::U16 => f64::from(u16::from_le_bytes(two())),
            Component::U32 => f64::from(u32::from_le_bytes(four())),
            Component::F32 => f64::from(f32::from_le_bytes(four())),
        }
    }
}

/// The type of an accessor's elements.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Shape {
    Scalar,
    Vec3,
    Vec4,
}

impl Shape {
    fn components(self) -> usize {
        match self {
            Shape::Scalar => 1,
            Shape::Vec3 => 3,
            Shape::Vec4 => 4,
        }
    }

    fn name(self) -> &'static str {
        match self {
            Shape::Scalar => "SCALAR",
            Shape::Vec3 => "VEC3",
            Shape::Vec4 => "VEC4",
        }
    }
}

/// The elements of an accessor: vectors or integers in a buffer. Nothing is copied, so a file that
/// refers to the same bytes a million times takes no memory.
#[derive(Clone, Copy)]
pub(super) struct Elements<'a> {
    /// The elements' bytes; empty if all of them are zero.
    bytes: &'a [u8],
    stride: usize,
    count: usize,
    component: Component,
    /// Factor by which a component is multiplied.
    factor: f64,
    sparse: Option<Sparse<'a>>,
}

/// Elements that replace some of an accessor's.
#[derive(Clone, Copy)]
struct Sparse<'a> {
    indices: &'a [u8],
    index_type: Component,
    values: &'a [u8],
    /// Bytes of an element.
    size: usize,
}

impl<'a> Sparse<'a> {
    fn count(&self) -> usize {
        self.indices.len() / self.index_type.size()
    }

    fn index(&self, i: usize) -> usize {
        let bytes = &self.indices[i * self.index_type.size()..];
        self.index_type.number(bytes) as usize
    }

    /// Returns the bytes of the element that replaces another; indices increase.
    fn replacement(&self, element: usize) -> Option<&'a [u8]> {
        let (mut low, mut high) = (0, self.count());
        while low < high {
            let middle = (low + high) / 2;
            match self.index(middle).cmp(&element) {
                std::cmp::Ordering::Less => low = middle + 1,
                std::cmp::Ordering::Greater => high = middle,
                std::cmp::Ordering::Equal => return Some(&self.values[middle * self.size..]),
            }
        }
        None
    }
}

const NONE: &str = "none of this number";
const BEYOND: [&str; 2] = ["elements within the buffer", "some beyond its end"];

/// Returns the bytes of a buffer view, and its stride.
fn view<'a>(
    root: &Root,
    buffers: &'a [Cow<'_, [u8]>],
    index: Whole,
    place: Place,
) -> Result<(&'a [u8], usize), ReadError> {
    let error = |[expected, found]: [&str; 2]| ReadError::at(place, expected, found);
    let view = root.buffer_views.get(index.index());
    let view = view.ok_or_else(|| error(["a buffer view", NONE]))?;
    let buffer = buffers.get(view.buffer.index());
    let buffer = buffer.ok_or_else(|| error(["a buffer", NONE]))?;
    let part = range(buffer, view.byte_offset.0, view.byte_length.0);
    let stride = view.byte_stride.index();
    Ok((part.ok_or_else(|| error(BEYOND))?, stride))
}

impl<'a> Elements<'a> {
    /// Returns the elements of an accessor. Without a buffer view they are zero, except for those
    /// that a sparse part replaces.
    ///
    /// # Errors
    /// The accessor does not exist, has another type, or extends beyond its buffer.
    pub fn of(
        root: &Root,
        buffers: &'a [Cow<'_, [u8]>],
        index: usize,
        wanted: Shape,
    ) -> Result<Self, ReadError> {
        let place = Place::Element("accessor", index);
        let error = |expected: &str, found: &str| ReadError::at(place, expected, found);
        let accessor = root.accessors.get(index);
        let accessor = accessor.ok_or_else(|| error("an accessor", NONE))?;
        if accessor.kind != wanted.name() {
            let expected = format!("type {}", wanted.name());
            return Err(error(&expected, "another"));
        }
        let Some(component) = Component::named(accessor.component_type) else {
            return Err(error("a known type of components", "another"));
        };
        let beyond = || error(BEYOND[0], BEYOND[1]);
        let size = component.size() * wanted.components();
        let count = accessor.count.0;
        let (mut bytes, mut stride) = (&[][..], size);
        if let Some(index) = accessor.buffer_view {
            let (part, view_stride) = view(root, buffers, index, place)?;
            stride = if view_stride == 0 { size } else { view_stride };
            if stride < size {
                return Err(error("elements that do not overlap", "a smaller stride"));
            }
            let length = match count.checked_sub(1) {
                None => Some(0),
                Some(before) => before
                    .checked_mul(stride as u64)
                    .and_then(|length| length.checked_add(size as u64)),
            };
            let found = length.and_then(|length| range(part, accessor.byte_offset.0, length));
            bytes = found.ok_or_else(beyond)?;
        }
        let mut sparse = None;
        if let Some(given) = accessor.sparse.as_deref() {
            let Some(index_type) = Component::named(given.indices.component_type) else {
                return Err(error("a known type of sparse indices", "another"));
            };
            let part = |index, offset: Whole, size: usize| {
                let (part, _) = view(root, buffers, index, place)?;
                let length = given.count.0.checked_mul(size as u64);
                let part = length.and_then(|length| range(part, offset.0, length));
                part.ok_or_else(beyond)
            };
            let (indices, values) = (&given.indices, &given.values);
            let found = Sparse {
                indices: part(indices.buffer_view, indices.byte_offset, index_type.size())?,
                index_type,
                values: part(values.buffer_view, values.byte_offset, size)?,
                size,
            };
            let mut before = None;
            for i in 0..found.count() {
                let index = Some(found.index(i));
                if index <= before || found.index(i) as u64 >= count {
                    let expected = "sparse indices that increase and are below the count";
                    return Err(error(expected, "others"));
                }
                before = index;
            }
            sparse = Some(found);
        }
        Ok(Elements {
            bytes,
            stride,
            count: usize::try_from(count).unwrap_or(usize::MAX),
            component,
            factor: match accessor.normalized {
                true => 1.0 / component.largest(),
                false => 1.0,
            },
            sparse,
        })
    }

    pub fn len(&self) -> usize {
        self.count
    }

    /// Returns the number of steps that creating this took.
    pub fn steps(&self) -> usize {
        self.sparse.map_or(0, |sparse| sparse.count())
    }

    /// Returns whether these are unsigned integers, as required of indices.
    pub fn are_indices(&self) -> bool {
        use Component::{U8, U16, U32};
        matches!(self.component, U8 | U16 | U32)
    }

    /// Returns whether all elements are zero because the file holds none.
    pub fn are_absent(&self) -> bool {
        self.bytes.is_empty() && self.sparse.is_none()
    }

    /// Returns the components of an element; `None` if the element does not exist.
    fn element<const N: usize>(&self, element: usize) -> Option<[f64; N]> {
        if element >= self.count {
            return None;
        }
        let replacement = self.sparse.and_then(|sparse| sparse.replacement(element));
        let bytes = match replacement {
            Some(bytes) => bytes,
            None if self.bytes.is_empty() => return Some([0.0; N]),
            None => &self.bytes[element * self.stride..],
        };
        let size = self.component.size();
        Some(std::array::from_fn(|i| {
            self.factor * self.component.number(&bytes[i * size..])
        }))
    }

    /// Returns a vector of three components; `None` if the element does not exist.
    pub fn vector(&self, element: usize) -> Option<Vec3> {
        self.element(element).map(Vec3::from_array)
    }

    /// Returns a vector of four components; `None` if the element does not exist.
    pub fn four(&self, element: usize) -> Option<[f64; 4]> {
        self.element(element)
    }

    /// Returns an integer; `None` if the element does not exist.
    pub fn whole(&self, element: usize) -> Option<usize> {
        let [number] = self.element(element)?;
        Some(number as usize)
    }
}

/// Returns a range of bytes; `None` if it extends beyond the end.
fn range(bytes: &[u8], start: u64, length: u64) -> Option<&[u8]> {
    let end = start.checked_add(length)?;
    bytes.get(usize::try_from(start).ok()?..usize::try_from(end).ok()?)
}
