//! What a comparison begins with as its second tree.

use super::Document;
use crate::setup::Setup;
use crate::structure::Method;

/// The build methods that B begins with: the second one if A has the first.
const METHODS: [&str; 2] = ["sah-cut", "midpoint"];

impl Document {
    /// Returns the setup that B begins with: that of the last comparison, at A's picture size, or else A's
    /// with another build method.
    pub(super) fn second_setup(&self) -> Setup {
        let a = &self.wanted;
        let last = self.last_other.clone().map(|mut setup| {
            setup.scene = a.scene.clone();
            setup.render.camera = a.render.camera;
            (setup.render.width, setup.render.height) = (a.render.width, a.render.height);
            setup
        });
        // A comparison of a tree with itself shows nothing.
        last.filter(|last| last != a).unwrap_or_else(|| {
            let name = METHODS
                .into_iter()
                .find(|name| *name != a.build.method.name);
            let method = Method::named(name.unwrap_or(METHODS[0]));
            let mut setup = a.clone();
            setup.build.set_method(method.expect("both are registered"));
            setup
        })
    }
}
