//! What must stay hidden until a prediction because it shows the answer.

use super::content::Step;
use super::figures::Name;
use crate::measure::heat::{RayFilter, heatmap};
use crate::measure::{COUNTERS, Counter};
use std::collections::BTreeSet;

/// The information that shows the answer to the question of a step. All other information can stay
/// visible.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Secret {
    /// Symbols of counters of the whole picture.
    counters: BTreeSet<&'static str>,
    /// Symbols of counters of the step's pixel.
    of_pixel: BTreeSet<&'static str>,
    difference: bool,
}

impl Step {
    /// Returns what must stay hidden until the prediction; nothing if nothing is asked.
    pub fn secret(&self) -> Secret {
        let mut secret = Secret::default();
        let formulas = self.question.iter().flat_map(|q| q.answer.formulas());
        for name in formulas.flat_map(|formula| formula.names()) {
            secret.add(name);
        }
        secret
    }
}

impl Secret {
    fn add(&mut self, name: &Name) {
        if name.is_given() {
            return;
        }
        match *name {
            Name::Parameter(_, parameter) => self.counters.extend(related(&[parameter.symbol])),
            Name::Total(_, heatmap) => {
                let mut symbols = heatmap.parameters(RayFilter::All).to_vec();
                symbols.push(heatmap.symbol);
                self.counters.extend(related(&symbols));
            }
            Name::Pixel(_, heatmap, _) => self.of_pixel.extend(related(&[heatmap.symbol])),
            Name::Differing | Name::Rmse => self.difference = true,
        }
    }

    /// Returns whether a counter of the whole picture shows the answer: a figure, or the number of
    /// leaves in a legend.
    pub fn hides_counter(&self, symbol: &str) -> bool {
        self.counters.contains(symbol)
    }

    /// Returns whether a heatmap shows the answer by its legend, its total or the value of a pixel.
    pub fn hides_heatmap(&self, symbol: &str) -> bool {
        let Some(heatmap) = heatmap(symbol) else {
            return false;
        };
        let parts = heatmap.parameters(RayFilter::All).iter();
        self.of_pixel.contains(heatmap.symbol)
            || parts
                .chain([&heatmap.symbol])
                .any(|s| self.hides_counter(s))
    }

    /// Returns whether the list of the pixel's rays, with a row of counts for each, shows the answer.
    pub fn hides_rays(&self) -> bool {
        !self.of_pixel.is_empty()
    }

    /// Returns whether the steps of a ray show the answer: its nodes, its leaves and its tests can be
    /// counted there, but not the number of rays.
    pub fn hides_steps(&self) -> bool {
        self.of_pixel.iter().any(|symbol| *symbol != "N_RAYS")
    }

    /// Returns whether the difference of the two pictures shows the answer.
    pub fn hides_difference(&self) -> bool {
        self.difference
    }
}

/// Returns the symbols of all counters from which these follow, and which follow from these, by one
/// formula.
fn related(symbols: &[&'static str]) -> BTreeSet<&'static str> {
    let asked = |symbol: &str| symbols.contains(&symbol);
    let of_asked: Vec<_> = COUNTERS.iter().filter(|c| asked(c.symbol)).collect();
    let is_related = |counter: &&Counter| {
        let follows = symbols.iter().any(|symbol| mentions(counter, symbol));
        // Of a sum, every part is hidden: the others may be known.
        let is_source = of_asked.iter().any(|of| mentions(of, counter.symbol));
        asked(counter.symbol) || follows || is_source && !is_specified(counter)
    };
    let related = COUNTERS.iter().filter(is_related);
    related.map(|counter| counter.symbol).collect()
}

fn is_specified(counter: &Counter) -> bool {
    let parameters = crate::measure::parameters().iter();
    let mut of_it = parameters.filter(|p| p.symbol == counter.symbol);
    of_it.any(|p| p.class == crate::measure::Class::S)
}

/// Returns whether the formula of a counter contains a symbol as a whole word.
fn mentions(counter: &Counter, symbol: &str) -> bool {
    let is_part = |c: char| c.is_alphanumeric() || c == '_';
    let mut words = counter.formula.split(|c| !is_part(c));
    words.any(|word| word == symbol)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lesson::Lesson;

    fn secret(question: &str) -> Secret {
        let text = format!(
            "+++\ntitle = \"T\"\nabout = \"A\"\n+++\n\n# Step\n\n```toml\nscene = \"tetra:2\"\n\
             a = \"method=midpoint\"\nb = \"method=none\"\npixel = [1, 1]\nquestion = \"?\"\n\
             {question}\n```\n\nx\n\n---\n\ny\n"
        );
        let lesson = Lesson::parse(&text, "test.md").expect("a lesson");
        lesson.steps[0].secret()
    }

    fn of_number(formula: &str) -> Secret {
        secret(&format!("number = \"{formula}\"\nwithin = \"1\""))
    }

    #[test]
    fn what_is_asked_is_hidden_with_what_follows_from_it() {
        let tests = of_number("a.N_IT / a.N_RAYS");
        for symbol in ["N_IT", "N_PRIT", "N_SRIT", "N_SECRIT", "N_RPRT", "N_PR"] {
            assert!(tests.hides_counter(symbol), "{symbol}");
        }
        for symbol in ["N_LS", "N_AOIL", "T_TR", "N_O", "R_FVWV"] {
            assert!(!tests.hides_counter(symbol), "{symbol}");
        }
        assert!(tests.hides_heatmap("N_IT") && tests.hides_heatmap("N_RPRT"));
        assert!(!tests.hides_heatmap("N_VLS"));
        assert!(!tests.hides_rays() && !tests.hides_steps() && !tests.hides_difference());

        let references = of_number("a.N_RO / a.N_O");
        for symbol in ["N_RO", "N_ADL", "N_AOIL", "N_AOIFL"] {
            assert!(references.hides_counter(symbol), "{symbol}");
        }
        assert!(!references.hides_counter("N_O"), "it is specified");
        assert!(!references.hides_counter("N_AT"));
    }

    #[test]
    fn questions_about_a_pixel_hide_its_rays() {
        let rays = of_number("a.pixel.N_RAYS");
        assert!(rays.hides_rays() && !rays.hides_steps());
        assert!(rays.hides_heatmap("N_RAYS") && !rays.hides_heatmap("N_IT"));
        let nodes = of_number("a.ray.N_INODES");
        assert!(nodes.hides_rays() && nodes.hides_steps());
        assert!(nodes.hides_heatmap("N_NODES") && !nodes.hides_counter("N_NODES"));
    }

    #[test]
    fn questions_about_pictures_hide_their_difference() {
        assert!(of_number("differing").hides_difference());
        let choice = secret("choices = [[\"x\", \"rmse < 1\"], [\"y\", \"rmse >= 1\"]]");
        assert!(choice.hides_difference());
        let compare = secret("compare = [\"b.N_LS\", \"a.N_LS\"]");
        assert!(compare.hides_counter("N_LS") && compare.hides_counter("N_AOIL"));
        assert!(!compare.hides_difference());
    }
}
