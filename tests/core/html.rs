//! Pages of HTML, parsed as browsers parse them.

use html5ever::driver::parse_document;
use html5ever::tendril::TendrilSink;
use markup5ever_rcdom::{Handle, NodeData, RcDom};

/// An element of a page, or the page itself.
#[derive(Clone)]
pub struct Element(Handle);

impl Element {
    /// Parses a page, which must have no error.
    pub fn page(text: &str) -> Element {
        let page = parse_document(RcDom::default(), Default::default()).one(text);
        let errors = page.errors.borrow();
        assert!(errors.is_empty(), "{errors:?}");
        Element(page.document.clone())
    }

    /// Returns all elements in this one, in the order of the page.
    pub fn elements(&self) -> Vec<Element> {
        let mut elements = Vec::new();
        for child in self.0.children.borrow().iter() {
            let child = Element(child.clone());
            let below = child.elements();
            if matches!(child.0.data, NodeData::Element { .. }) {
                elements.push(child);
            }
            elements.extend(below);
        }
        elements
    }

    /// Returns all elements in this one with a name.
    pub fn named(&self, name: &str) -> Vec<Element> {
        let mut elements = self.elements();
        elements.retain(|element| element.name() == name);
        elements
    }

    pub fn name(&self) -> &str {
        match &self.0.data {
            NodeData::Element { name, .. } => &name.local,
            _ => "",
        }
    }

    pub fn attributes(&self) -> Vec<(String, String)> {
        let NodeData::Element { attrs, .. } = &self.0.data else {
            return Vec::new();
        };
        let attributes = attrs.borrow();
        let pairs = attributes.iter();
        pairs
            .map(|a| (a.name.local.to_string(), a.value.to_string()))
            .collect()
    }

    /// Returns the text in this element.
    pub fn text(&self) -> String {
        if let NodeData::Text { contents } = &self.0.data {
            return contents.borrow().to_string();
        }
        let children = self.0.children.borrow();
        let texts = children.iter().map(|child| Element(child.clone()).text());
        texts.collect()
    }
}
