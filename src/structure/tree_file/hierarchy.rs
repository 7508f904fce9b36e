//! A hierarchy of another program, to be written to a file.

use super::data::Data;
use super::header::{Header, Kind, Number, Order};
use std::io::{self, Write};

/// What a node of a [`Hierarchy`] holds.
#[derive(Clone, Debug, PartialEq)]
pub enum Holds {
    /// Indices of its children.
    Children(Vec<u32>),
    /// Indices of the objects of a leaf.
    Objects(Vec<u32>),
}

/// A bounding volume hierarchy as other programs have it.
#[derive(Clone, Debug, PartialEq)]
pub struct Hierarchy {
    /// The most children of a node, 2 to 8.
    pub width: u32,
    /// Number of objects of the scene.
    pub objects: u32,
    /// Nodes in any order, the root first, each with the lower and the upper corner of its box.
    pub nodes: Vec<([[f32; 3]; 2], Holds)>,
}

impl Hierarchy {
    /// Writes it to a tree file. Nothing is checked before it is read.
    ///
    /// # Errors
    /// I/O errors.
    pub fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        let (mut child, mut references, mut ranges) = (Vec::new(), Vec::new(), Vec::new());
        for (_, holds) in &self.nodes {
            let (all, own) = match holds {
                Holds::Children(own) => (&mut child, own),
                Holds::Objects(own) => (&mut references, own),
            };
            ranges.push([all.len() as u32, own.len() as u32]);
            all.extend(own);
        }
        let mut data = Data::default();
        let corners = self
            .nodes
            .iter()
            .flat_map(|(corners, _)| corners.as_flattened());
        data.add(
            ("box", Number::F32, 6),
            corners.map(|number| number.to_le_bytes()),
        );
        let is_leaf = |(_, holds): &(_, Holds)| u8::from(matches!(holds, Holds::Objects(_)));
        data.u8s("leaf", self.nodes.iter().map(is_leaf));
        data.u32s("first", ranges.iter().map(|range| range[0]));
        data.u32s("count", ranges.iter().map(|range| range[1]));
        data.u32s("child", child.into_iter());
        data.u32s("ref", references.into_iter());
        data.write(
            Header {
                width: self.width,
                ..Header::new(Kind::Bvh, self.objects, Order::FileFace)
            },
            out,
        )
    }
}
