//! Search for nodes: `depth 12`, `objects > 8`, `object 138`, `stop depth`.

use super::index::TreeIndex;
use super::node::{NodeKind, StopReason};
use super::tree::Tree;

/// A search query; parsed by [`Query::parse`].
#[derive(Clone, Debug, PartialEq)]
pub enum Query {
    /// The node with this index.
    Node(u32),
    /// The leaves that refer to this object.
    Object(u32),
    /// The leaves with one of these stop reasons.
    Stop(Vec<StopReason>),
    /// The nodes whose number satisfies a comparison.
    Number(Field, Order, f64),
}

/// A number that is known of every node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Field {
    /// Levels below the root.
    Depth,
    /// Objects in a leaf; never matches inner nodes.
    Objects,
    /// References in the subtree.
    References,
    /// Leaves in the subtree.
    Leaves,
    /// Surface area, in percent of that of the root.
    Area,
    /// Expected number of intersection tests of a ray through the cell.
    Tests,
    /// Number of rays of the picture that visited the node.
    Visits,
}

/// A comparison operator.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Order {
    Equal,
    Less,
    AtMost,
    Greater,
    AtLeast,
}

const FIELDS: &[(&str, Field)] = &[
    ("depth", Field::Depth),
    ("objects", Field::Objects),
    ("references", Field::References),
    ("leaves", Field::Leaves),
    ("area", Field::Area),
    ("tests", Field::Tests),
    ("visits", Field::Visits),
];

/// Longer operators come first, or `>=` would be parsed as `>`.
const ORDERS: &[(&str, Order)] = &[
    ("<=", Order::AtMost),
    (">=", Order::AtLeast),
    ("≤", Order::AtMost),
    ("≥", Order::AtLeast),
    ("<", Order::Less),
    (">", Order::Greater),
    ("=", Order::Equal),
];

impl Query {
    /// Parses a query.
    ///
    /// # Errors
    /// One sentence on what was expected.
    pub fn parse(text: &str) -> Result<Query, String> {
        let text = text.trim();
        let word_end = text
            .find(|c: char| !c.is_ascii_alphabetic())
            .unwrap_or(text.len());
        let (word, rest) = (text[..word_end].to_lowercase(), text[word_end..].trim());
        let whole = || {
            let number = rest.trim_start_matches(['=', '#']).trim();
            number
                .parse()
                .map_err(|_| format!("expected a whole number after '{word}', found '{rest}'"))
        };
        match word.as_str() {
            "node" => Ok(Query::Node(whole()?)),
            "object" => Ok(Query::Object(whole()?)),
            "stop" => reasons(rest).map(Query::Stop),
            "empty" if rest.is_empty() => Ok(Query::Number(Field::Objects, Order::Equal, 0.0)),
            _ => {
                let (_, field) = FIELDS.iter().find(|(name, _)| *name == word).ok_or_else(|| {
                    format!(
                        "expected node, object, stop, empty, depth, objects, references, leaves, \
                         area, tests or visits, found '{text}'"
                    )
                })?;
                let (order, number) = ORDERS
                    .iter()
                    .find_map(|(sign, order)| Some((*order, rest.strip_prefix(sign)?)))
                    .unwrap_or((Order::Equal, rest));
                let number = number.trim().trim_end_matches('%').trim();
                let number = number
                    .parse()
                    .map_err(|_| format!("expected a number after '{word}', found '{rest}'"))?;
                Ok(Query::Number(*field, order, number))
            }
        }
    }

    /// Returns whether the query needs visit counts.
    pub fn needs_visits(&self) -> bool {
        matches!(self, Query::Number(Field::Visits, ..))
    }

    /// Returns all matching nodes in array order. `visits` has the visit count of every node;
    /// without it, no node matches a query on visits.
    pub fn find(&self, tree: &Tree, index: &TreeIndex, visits: Option<&[u64]>) -> Vec<u32> {
        let nodes = 0..index.len() as u32;
        match self {
            Query::Node(node) => nodes.filter(|n| n == node).collect(),
            Query::Object(object) => index.leaves_of(*object).to_vec(),
            Query::Stop(reasons) => nodes
                .filter(|&node| match tree.kind(node) {
                    NodeKind::Leaf { stop, .. } => reasons.contains(&stop),
                    NodeKind::Inner => false,
                })
                .collect(),
            Query::Number(field, order, number) => {
                let root = index.of(0).area;
                nodes
                    .filter(|&node| {
                        let facts = index.of(node);
                        let is_leaf = facts.end == node + 1;
                        let value = match field {
                            Field::Depth => f64::from(facts.depth),
                            Field::Objects if !is_leaf => return false,
                            Field::Objects => f64::from(facts.objects),
                            Field::References => f64::from(facts.references),
                            Field::Leaves => f64::from(facts.leaves),
                            Field::Area => 100.0 * facts.area / root,
                            Field::Tests => facts.tests,
                            Field::Visits => match visits {
                                Some(visits) => visits[node as usize] as f64,
                                None => return false,
                            },
                        };
                        order.holds(value, *number)
                    })
                    .collect()
            }
        }
    }
}

impl Order {
    fn holds(self, value: f64, number: f64) -> bool {
        match self {
            Order::Equal => value == number,
            Order::Less => value < number,
            Order::AtMost => value <= number,
            Order::Greater => value > number,
            Order::AtLeast => value >= number,
        }
    }
}

/// Returns the reasons whose text contains the words, such as `depth` in "depth D_MAX reached".
fn reasons(words: &str) -> Result<Vec<StopReason>, String> {
    let words = words.to_lowercase();
    let found: Vec<_> = StopReason::ALL
        .into_iter()
        .filter(|reason| reason.text().to_lowercase().contains(&words))
        .collect();
    if words.is_empty() || found.is_empty() {
        let all: Vec<_> = StopReason::ALL.iter().map(|reason| reason.text()).collect();
        return Err(format!(
            "expected part of a reason after 'stop': {}",
            all.join("; ")
        ));
    }
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::structure::index::tests::small;

    #[test]
    fn queries_are_read_or_say_what_was_expected() {
        let depth = Query::Number(Field::Depth, Order::Equal, 12.0);
        assert_eq!(Query::parse("depth 12"), Ok(depth.clone()));
        assert_eq!(Query::parse(" Depth=12 "), Ok(depth));
        let many = Query::Number(Field::Objects, Order::AtLeast, 8.0);
        assert_eq!(Query::parse("objects >= 8"), Ok(many));
        assert_eq!(Query::parse("object 138"), Ok(Query::Object(138)));
        let deepest = Query::Stop(vec![StopReason::MaxDepth]);
        assert_eq!(Query::parse("stop depth"), Ok(deepest));
        let wide = Query::Number(Field::Area, Order::Greater, 2.5);
        assert_eq!(Query::parse("area > 2.5 %"), Ok(wide));
        for wrong in [
            "",
            "depth",
            "depth x",
            "objects > ",
            "object",
            "stop nothing",
            "7",
        ] {
            let why = Query::parse(wrong).unwrap_err();
            assert!(why.contains("expected"), "{wrong}: {why}");
        }
    }

    #[test]
    fn what_is_found_is_what_was_asked_for() {
        let (scene, tree) = small("balls:1", "midpoint");
        let index = TreeIndex::new(&tree, scene.objects().len());
        let find = |text: &str| Query::parse(text).unwrap().find(&tree, &index, None);
        assert_eq!(find("node 3"), [3]);
        assert_eq!(find("depth 0"), [0]);
        assert_eq!(find("object 2"), index.leaves_of(2));
        let crowded = find("objects > 1");
        assert!(!crowded.is_empty());
        assert!(crowded.iter().all(|&n| tree.leaf_objects(n).len() > 1));
        let leaves = tree.nodes().len() / 2 + 1;
        assert_eq!(find("empty").len() + find("objects > 0").len(), leaves);
        assert_eq!(find("leaves = 1").len(), leaves);
        assert_eq!(find("area 100 %"), [0]);
        assert!(!find("stop d_max").is_empty());
        let often = Query::parse("visits >= 3").unwrap();
        assert!(often.needs_visits() && find("visits >= 3").is_empty());
        let visits: Vec<u64> = (0..tree.nodes().len() as u64).map(|n| n % 5).collect();
        let found = often.find(&tree, &index, Some(&visits));
        assert!(found.starts_with(&[3, 4, 8, 9]) && found.iter().all(|n| n % 5 >= 3));
    }
}
