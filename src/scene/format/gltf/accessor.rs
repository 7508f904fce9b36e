//! Accessors: views of numbers in buffers, checked before anything is read.

use crate::geometry::Vec3;
use crate::scene::format::error::ReadError;
use crate::scene::format::place::Place;
use gltf_json::accessor::{ComponentType, Type};
use gltf_json::validation::Checked;
use gltf_json::{Accessor, Index, Root};
use std::borrow::Cow;

/// The elements of an accessor: vectors or integers in a buffer. Nothing is copied, so a file that
/// refers to the same bytes a million times takes no memory.
#[derive(Clone, Copy)]
pub(super) struct Elements<'a> {
    bytes: &'a [u8],
    stride: usize,
    count: usize,
    component: ComponentType,
    /// Factor by which a component is multiplied.
    factor: f64,
}

impl<'a> Elements<'a> {
    /// Returns the elements of an accessor of three-component vectors or of scalars; `None` if it
    /// is sparse.
    ///
    /// # Errors
    /// The accessor does not exist, has another type, or extends beyond its buffer.
    pub fn of(
        root: &Root,
        buffers: &'a [Cow<'_, [u8]>],
        index: Index<Accessor>,
        wanted: Type,
    ) -> Result<Option<Self>, ReadError> {
        let place = Place::Element("accessor", index.value());
        let error = |expected: &str, found: &str| ReadError::at(place, expected, found);
        let none = "none of this number";
        let accessor = root.accessors.get(index.value());
        let accessor = accessor.ok_or_else(|| error("an accessor", none))?;
        if accessor.type_ != Checked::Valid(wanted) {
            let expected = match wanted {
                Type::Scalar => "type SCALAR",
                _ => "type VEC3",
            };
            return Err(error(expected, "another"));
        }
        let Checked::Valid(component) = accessor.component_type else {
            return Err(error("a known type of components", "another"));
        };
        if accessor.sparse.is_some() {
            return Ok(None);
        }
        let view = accessor
            .buffer_view
            .and_then(|view| root.buffer_views.get(view.value()))
            .ok_or_else(|| error("a buffer view", none))?;
        let buffer = buffers.get(view.buffer.value());
        let buffer = buffer.ok_or_else(|| error("a buffer", none))?;
        let beyond = || error("elements within the buffer", "some beyond its end");
        let start = view.byte_offset.unwrap_or_default().0;
        let part = range(buffer, start, view.byte_length.0).ok_or_else(beyond)?;

        let size = component.0.size() * wanted.multiplicity();
        let stride = view.byte_stride.map_or(0, |stride| stride.0);
        let stride = if stride == 0 { size } else { stride };
        if stride < size {
            return Err(error("elements that do not overlap", "a smaller stride"));
        }
        let count = accessor.count.0;
        let length = match count.checked_sub(1) {
            None => Some(0),
            Some(before) => before
                .checked_mul(stride as u64)
                .and_then(|length| length.checked_add(size as u64)),
        };
        let offset = accessor.byte_offset.unwrap_or_default().0;
        let bytes = length.and_then(|length| range(part, offset, length));
        let whole = match component.0 {
            ComponentType::I8 => f64::from(i8::MAX),
            ComponentType::U8 => f64::from(u8::MAX),
            ComponentType::I16 => f64::from(i16::MAX),
            ComponentType::U16 => f64::from(u16::MAX),
            ComponentType::U32 | ComponentType::F32 => 1.0,
        };
        Ok(Some(Elements {
            bytes: bytes.ok_or_else(beyond)?,
            stride,
            // At most the number of bytes of the buffer.
            count: count as usize,
            component: component.0,
            factor: if accessor.normalized {
                1.0 / whole
            } else {
                1.0
            },
        }))
    }

    pub fn len(&self) -> usize {
        self.count
    }

    /// Returns whether these are unsigned integers, as required of indices.
    pub fn are_indices(&self) -> bool {
        use ComponentType::{U8, U16, U32};
        matches!(self.component, U8 | U16 | U32)
    }

    /// Returns component `i` of an element, which must exist.
    fn component(&self, element: usize, i: usize) -> f64 {
        let at = element * self.stride + i * self.component.size();
        let bytes = &self.bytes[at..];
        match self.component {
            ComponentType::I8 => f64::from(bytes[0] as i8),
            ComponentType::U8 => f64::from(bytes[0]),
            ComponentType::I16 => f64::from(i16::from_le_bytes([bytes[0], bytes[1]])),
            ComponentType::U16 => f64::from(u16::from_le_bytes([bytes[0], bytes[1]])),
            ComponentType::U32 => {
                f64::from(u32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]))
            }
            ComponentType::F32 => {
                f64::from(f32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]))
            }
        }
    }

    /// Returns a vector; `None` if the element does not exist.
    pub fn vector(&self, element: usize) -> Option<Vec3> {
        let part = |i| self.component(element, i);
        (element < self.count).then(|| self.factor * Vec3::new(part(0), part(1), part(2)))
    }

    /// Returns an integer; `None` if the element does not exist.
    pub fn whole(&self, element: usize) -> Option<usize> {
        (element < self.count).then(|| self.component(element, 0) as usize)
    }
}

/// Returns a range of bytes; `None` if it extends beyond the end.
fn range(bytes: &[u8], start: u64, length: u64) -> Option<&[u8]> {
    let end = start.checked_add(length)?;
    bytes.get(usize::try_from(start).ok()?..usize::try_from(end).ok()?)
}
