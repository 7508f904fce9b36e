//! Settings: their names, descriptions, allowed values, and how values are written.

use super::Setup;
use crate::geometry::Vec3;
use crate::scene::Cylinders;
use crate::structure::split::Constant;
use crate::structure::tree_file::EXTENSION;
use crate::structure::{MaxDepth, Method};

/// A setting of the experiment. Options, widgets, files, sweep axes and report lines are generated
/// from it.
#[derive(Clone, Copy)]
pub struct Setting {
    /// Name on the command line and in files, such as `d-max`.
    pub name: &'static str,
    /// Earlier and shorter names.
    pub aliases: &'static [&'static str],
    /// The paper's symbol, such as `D_MAX`.
    pub symbol: Option<&'static str>,
    /// Name in the window, such as `Root margin`.
    pub label: &'static str,
    pub group: Group,
    /// What it does: help and tooltip.
    pub about: &'static str,
    pub kind: Kind,
    /// What a change invalidates.
    pub affects: Affects,
    pub get: fn(&Setting, &Setup) -> Value,
    /// Stores a value of this setting's kind.
    pub set: fn(&Setting, &mut Setup, Value),
}

/// The group in which a setting is listed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Group {
    Scene,
    Structure,
    Picture,
    Camera,
}

impl Group {
    /// Returns the heading in `--help`.
    pub const fn title(self) -> &'static str {
        match self {
            Group::Scene => "Scene",
            Group::Structure => "Tree",
            Group::Picture => "Picture",
            Group::Camera => "Camera",
        }
    }
}

/// What a change of a setting invalidates. Each entry also invalidates all later ones.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Affects {
    /// The scene must be loaded again.
    Scene,
    /// The tree must be built again.
    Structure,
    /// The picture changes.
    Image,
    /// Only times change.
    Time,
}

/// The allowed values of a setting.
#[derive(Clone, Copy)]
pub enum Kind {
    Number(Range),
    /// One of several names.
    Choice(fn() -> Vec<Choice>),
    /// A build method, or a tree file.
    Method,
    /// 0 or 1.
    Switch,
    /// Width and height in pixels.
    Size,
    /// A point or a direction, or the scene's own.
    Point,
    /// A number, or the scene's own.
    Angle(Range),
    Depth,
    /// A number, or one that follows from the scene.
    Automatic(Range),
    Cylinders,
}

/// A range of allowed numbers, including both ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    pub lowest: f64,
    pub highest: f64,
    /// Whether only integers are allowed.
    pub whole: bool,
    /// Unit, such as `MiB`; empty for a number without a unit.
    pub unit: &'static str,
}

/// One of several named values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Choice {
    pub name: &'static str,
    /// The name in earlier versions.
    pub old_name: Option<&'static str>,
    pub about: &'static str,
    /// The heading under which lists have it; empty in lists without headings. Choices with the same heading
    /// follow each other.
    pub group: &'static str,
}

/// The value of a setting.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Value {
    Number(f64),
    Choice(&'static str),
    Switch(bool),
    Size([u32; 2]),
    Point(Vec3),
    Depth(MaxDepth),
    Cylinders(Cylinders),
    /// The value of the scene.
    Own,
    /// The value that follows from the scene.
    Automatic,
}

/// The text for [`Value::Automatic`].
const AUTOMATIC: &str = "auto";

/// The text for [`Value::Own`].
const OWN: &str = "scene";

impl Setting {
    /// Returns the setting for a constant of a build method.
    pub const fn of_constant(constant: &'static Constant) -> Setting {
        let is_switch = constant.step == 1.0 && constant.lowest == 0.0 && constant.highest == 1.0;
        Setting {
            name: constant.name,
            aliases: &[],
            symbol: None,
            label: constant.name,
            group: Group::Structure,
            about: constant.about,
            kind: if is_switch {
                Kind::Switch
            } else {
                Kind::Number(Range {
                    lowest: constant.lowest,
                    highest: constant.highest,
                    whole: constant.step > 0.0,
                    unit: constant.unit,
                })
            },
            affects: Affects::Structure,
            get: |setting, setup| {
                let value = setup.build.constant(setting.name);
                match setting.kind {
                    Kind::Switch => Value::Switch(value != 0.0),
                    _ => Value::Number(value),
                }
            },
            set: |setting, setup, value| {
                let value = match value {
                    Value::Switch(on) => f64::from(u8::from(on)),
                    value => value.number(),
                };
                let name = setting.name;
                let known = setup.build.method.constants.iter();
                let default = known.filter(|c| c.name == name).map(|c| c.default).next();
                if default == Some(value) {
                    setup.build.constants.remove(name);
                } else {
                    setup.build.constants.insert(name.to_owned(), value);
                }
            },
        }
    }

    /// Returns whether this is a name or alias of the setting.
    pub fn is_called(&self, name: &str) -> bool {
        self.name == name || self.aliases.contains(&name)
    }

    /// Returns the symbol if there is one, else the label in lower case.
    pub fn word(&self) -> String {
        self.symbol
            .map_or_else(|| self.label.to_lowercase(), str::to_owned)
    }

    /// Returns the value in a setup.
    pub fn value(&self, setup: &Setup) -> Value {
        (self.get)(self, setup)
    }

    /// Returns the value in a setup as text that [`Setting::parse`] reads.
    pub fn text(&self, setup: &Setup) -> String {
        self.value(setup).to_string()
    }

    /// Stores a value in a setup.
    ///
    /// # Panics
    /// If the value is of another kind.
    pub fn store(&self, setup: &mut Setup, value: Value) {
        (self.set)(self, setup, value);
    }

    /// Returns the default value for the method of a setup.
    pub fn default(&self, setup: &Setup) -> Value {
        let mut plain = Setup::default();
        plain.build.method = setup.build.method;
        self.value(&plain)
    }

    /// Returns whether the value in a setup is the default.
    pub fn is_default(&self, setup: &Setup) -> bool {
        self.value(setup) == self.default(setup)
    }

    /// Parses an allowed value.
    ///
    /// # Errors
    /// What was expected.
    pub fn parse(&self, text: &str) -> Result<Value, String> {
        self.check(self.read(text)?)
    }

    /// Parses a value of the right form, whether it is allowed or not.
    ///
    /// # Errors
    /// What was expected.
    pub fn read(&self, text: &str) -> Result<Value, String> {
        let text = text.trim();
        let value = match self.kind {
            Kind::Number(_) => text.parse().ok().map(Value::Number),
            Kind::Choice(choices) => choices()
                .into_iter()
                .find(|choice| choice.name == text || choice.old_name == Some(text))
                .map(|choice| Value::Choice(choice.name)),
            Kind::Method => match Method::named(text) {
                Ok(method) => Some(Value::Choice(method.info().name)),
                Err(_) => None,
            },
            Kind::Switch => match text {
                "0" | "false" => Some(Value::Switch(false)),
                "1" | "true" => Some(Value::Switch(true)),
                _ => None,
            },
            Kind::Size => text.split_once(['x', '×']).and_then(|(width, height)| {
                let side = |text: &str| text.trim().parse::<u32>().ok();
                Some(Value::Size([side(width)?, side(height)?]))
            }),
            Kind::Point | Kind::Angle(_) if text == OWN => Some(Value::Own),
            Kind::Point => point(text).map(Value::Point),
            Kind::Automatic(_) if text == AUTOMATIC => Some(Value::Automatic),
            Kind::Angle(_) | Kind::Automatic(_) => text.parse().ok().map(Value::Number),
            Kind::Depth => return Ok(Value::Depth(text.parse()?)),
            Kind::Cylinders => return Ok(Value::Cylinders(text.parse()?)),
        };
        value.ok_or_else(|| format!("expected {}, found '{text}'", self.expected()))
    }

    /// Checks that a value is allowed.
    ///
    /// # Errors
    /// What was expected.
    pub fn check(&self, value: Value) -> Result<Value, String> {
        let is_allowed = match (self.kind, value) {
            (
                Kind::Number(range) | Kind::Angle(range) | Kind::Automatic(range),
                Value::Number(number),
            ) => range.contains(number),
            (Kind::Size, Value::Size(sides)) => !sides.contains(&0),
            (Kind::Point, Value::Point(point)) => point.is_finite(),
            _ => true,
        };
        if is_allowed {
            Ok(value)
        } else {
            Err(format!("expected {}, found '{value}'", self.expected()))
        }
    }

    /// Describes the allowed values.
    pub fn expected(&self) -> String {
        match self.kind {
            Kind::Number(range) => range.in_words(),
            Kind::Choice(choices) => {
                let names: Vec<_> = choices().iter().map(|choice| choice.name).collect();
                format!("one of {}", names.join(", "))
            }
            Kind::Method => {
                let names: Vec<_> = Method::all().map(|method| method.name).collect();
                let names = names.join(", ");
                format!("one of {names}, or a tree file (.{EXTENSION})")
            }
            Kind::Switch => "0 or 1".into(),
            Kind::Size => "a width and a height of at least 1 pixel, such as 512x512".into(),
            Kind::Point => format!("three numbers, such as 0,-4,1.5, or '{OWN}'"),
            Kind::Angle(range) => format!("{} or '{OWN}'", range.in_words()),
            Kind::Depth => format!("a depth from 0 to {} or '{AUTOMATIC}'", MaxDepth::LIMIT),
            Kind::Automatic(range) => format!("{} or '{AUTOMATIC}'", range.in_words()),
            Kind::Cylinders => "'exact' or 'polygons:N'".into(),
        }
    }

    /// Parses values separated by commas, for an axis of a sweep: `f32,f64`. Integers and depths
    /// can also be ranges such as `8..24`. Points are separated by semicolons.
    ///
    /// # Errors
    /// What was expected, or a value that occurs twice.
    pub fn parse_list(&self, text: &str) -> Result<Vec<Value>, String> {
        let separator = if matches!(self.kind, Kind::Point) {
            ';'
        } else {
            ','
        };
        let mut values = Vec::new();
        for part in text.split(separator) {
            let new = match part.split_once("..") {
                Some((from, to)) if self.has_ranges() => self.parse_range(from, to)?,
                _ => vec![self.parse(part)?],
            };
            for value in new {
                if values.contains(&value) {
                    return Err(format!("{value} occurs twice"));
                }
                values.push(value);
            }
        }
        Ok(values)
    }

    /// Returns some values that are allowed, for tests that go through all settings.
    pub fn examples(&self) -> Vec<Value> {
        match self.kind {
            Kind::Number(range) | Kind::Angle(range) if range.whole => {
                vec![
                    Value::Number(range.lowest + 2.0),
                    Value::Number(range.lowest + 3.0),
                ]
            }
            Kind::Number(range) | Kind::Angle(range) => {
                let width = (range.highest - range.lowest).min(1.0);
                vec![
                    Value::Number(range.lowest + width / 3.0),
                    Value::Number(range.lowest + width * (0.1 + 0.2)),
                ]
            }
            Kind::Choice(choices) => {
                let names = choices().into_iter().map(|c| Value::Choice(c.name));
                names.collect()
            }
            Kind::Method => Method::all()
                .map(|m| Value::Choice(m.info().name))
                .collect(),
            Kind::Switch => [false, true].map(Value::Switch).to_vec(),
            Kind::Size => vec![Value::Size([24, 16]), Value::Size([16, 8])],
            Kind::Point => vec![
                Value::Point(Vec3::new(-1.0 / 3.0, -2e-9, 3e20)),
                Value::Point(Vec3::new(0.0, -1.0, 7.0)),
            ],
            Kind::Depth => [MaxDepth::Fixed(7), MaxDepth::Automatic]
                .map(Value::Depth)
                .to_vec(),
            Kind::Automatic(range) => vec![Value::Number(range.lowest + 0.3), Value::Automatic],
            Kind::Cylinders => vec![Value::Cylinders(Cylinders::Polygons(10))],
        }
    }

    fn has_ranges(&self) -> bool {
        matches!(self.kind, Kind::Depth) || matches!(self.kind, Kind::Number(range) if range.whole)
    }

    fn parse_range(&self, from: &str, to: &str) -> Result<Vec<Value>, String> {
        /// Longer ranges are probably typing errors.
        const LONGEST: u32 = 10_000;
        let ends = from.trim().parse::<u32>().ok().zip(to.trim().parse().ok());
        let (from, to) = ends
            .filter(|(from, to)| from <= to && to - from < LONGEST)
            .ok_or_else(|| {
                let expected = self.expected();
                format!("expected {expected}, or a range such as 8..24, found '{from}..{to}'")
            })?;
        (from..=to).map(|n| self.parse(&n.to_string())).collect()
    }
}

impl Range {
    /// Returns whether a number is in the range.
    pub fn contains(&self, number: f64) -> bool {
        (self.lowest..=self.highest).contains(&number) && !(self.whole && number.fract() != 0.0)
    }

    fn in_words(&self) -> String {
        let number = if self.whole { "an integer" } else { "a number" };
        if self.highest == f64::MAX {
            format!("{number} of at least {}", self.lowest)
        } else {
            format!("{number} from {} to {}", self.lowest, self.highest)
        }
    }
}

fn point(text: &str) -> Option<Vec3> {
    let numbers: Option<Vec<f64>> = text.split(',').map(|n| n.trim().parse().ok()).collect();
    match numbers.as_deref() {
        Some(&[x, y, z]) => Some(Vec3::new(x, y, z)),
        _ => None,
    }
}

impl Value {
    /// Returns the number of [`Value::Number`].
    ///
    /// # Panics
    /// If this is another kind of value.
    pub fn number(self) -> f64 {
        match self {
            Value::Number(number) => number,
            other => panic!("{other} is not a number"),
        }
    }

    /// Returns the name of [`Value::Choice`].
    ///
    /// # Panics
    /// If this is another kind of value.
    pub fn choice(self) -> &'static str {
        match self {
            Value::Choice(name) => name,
            other => panic!("{other} is not one of some names"),
        }
    }
}

impl std::fmt::Display for Value {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Value::Number(number) => write!(f, "{number}"),
            Value::Choice(name) => f.write_str(name),
            Value::Switch(on) => write!(f, "{}", u8::from(*on)),
            Value::Size([width, height]) => write!(f, "{width}x{height}"),
            Value::Point(p) => write!(f, "{},{},{}", p.x, p.y, p.z),
            Value::Depth(depth) => write!(f, "{depth}"),
            Value::Cylinders(cylinders) => write!(f, "{cylinders}"),
            Value::Own => f.write_str(OWN),
            Value::Automatic => f.write_str(AUTOMATIC),
        }
    }
}
