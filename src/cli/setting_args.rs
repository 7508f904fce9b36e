//! Options generated from [`SETTINGS`], and the setups that they resolve to.

use super::values::{MethodParser, constant};
use crate::scene::{SceneRequest, SceneSource};
use crate::setup::{Edits, Group, Kind, SETTINGS, Setting, Setup};
use crate::structure::Method;
use anyhow::{Result, anyhow, bail};
use clap::builder::{PossibleValue, PossibleValuesParser, ValueParser};
use clap::error::Error;
use clap::{Arg, ArgAction, ArgMatches, Args, Command, FromArgMatches};
use std::marker::PhantomData;

/// The settings that a command offers.
pub trait Offer {
    /// Returns whether a setting is an option of the command.
    fn has(setting: &Setting) -> bool;

    /// The default methods.
    fn methods() -> Methods;

    /// Returns the default of an option, if it differs from that of the setting.
    fn default(_: &Setting) -> Option<&'static str> {
        None
    }
}

/// The default methods of a command.
pub enum Methods {
    /// One method; the command takes only one.
    One(&'static str),
    /// The two methods of the paper.
    Paper,
    /// All methods except `none`.
    AllButNone,
    /// The command tries methods on its own, with the default values of their settings.
    Searched,
}

impl Methods {
    fn about(&self) -> &'static str {
        match self {
            Methods::One(_) => "Build method, or a tree file (.bstree)",
            Methods::Paper => {
                "Build method, or a tree file (.bstree). Can be repeated [default: the two methods of the \
                 paper]"
            }
            Methods::AllButNone => {
                "Build method, or a tree file (.bstree). Can be repeated [default: all except none]"
            }
            Methods::Searched => "Build method",
        }
    }

    fn list(&self) -> Vec<Method> {
        match self {
            Methods::One(name) => Method::all().filter(|m| m.name == *name).collect(),
            Methods::Paper | Methods::Searched => Method::of_the_paper(),
            Methods::AllButNone => Method::all().filter(|m| m.name != "none").collect(),
        }
    }
}

/// Declares what a command offers: its settings, its default methods and, in brackets, other
/// defaults.
macro_rules! offers {
    ($($(#[$about:meta])* $name:ident: |$setting:ident| $has:expr, $methods:expr, [$($option:literal = $default:literal),*];)+) => {
        $(
            $(#[$about])*
            #[derive(Clone, Debug)]
            pub struct $name;

            impl Offer for $name {
                fn has($setting: &Setting) -> bool {
                    $has
                }

                fn methods() -> Methods {
                    $methods
                }

                fn default(setting: &Setting) -> Option<&'static str> {
                    [$(($option, $default)),*]
                        .into_iter()
                        .find_map(|(name, default): (&str, _)| (setting.name == name).then_some(default))
                }
            }
        )+
    };
}

offers! {
    /// All settings, with one or more methods.
    Everything: |_setting| true, Methods::Paper, [];
    /// All settings, with one method.
    OneMethod: |_setting| true, Methods::One("midpoint"), [];
    /// The settings that both sides of a comparison share by default.
    Shared: |setting| setting.group != Group::Structure, Methods::Paper, [];
    /// The settings that are not an axis of every sweep.
    Swept: |setting| !["method", "d-max", "n-oilf"].contains(&setting.name), Methods::Paper, [];
    /// The scene and the tree.
    Built: |setting| {
        matches!(setting.group, Group::Scene | Group::Structure) || setting.name == "threads"
    }, Methods::One("midpoint"), [];
    /// Only the scene.
    Loaded: |setting| setting.group == Group::Scene, Methods::Paper, [];
    /// The scene, for answers about rays.
    Answered: |setting| setting.group == Group::Scene || setting.name == "threads", Methods::Paper, [];
    /// The settings that determine the hits of rays.
    Verified: |setting| {
        !["resolution", "samples-per-pixel"].contains(&setting.name)
    }, Methods::AllButNone, [];
    /// The settings that the extreme cases do not fix.
    Extreme: |setting| {
        ["cylinders", "method", "threads"].contains(&setting.name)
    }, Methods::AllButNone, [];
    /// The settings that the time model does not fix.
    Modelled: |setting| {
        ["cylinders", "resolution"].contains(&setting.name)
    }, Methods::Paper, ["resolution" = "192x192"];
    /// The settings that the paper's experiment does not fix.
    Reproduced: |setting| {
        ["resolution", "threads"].contains(&setting.name)
    }, Methods::Paper, [];
    /// The reference of an accuracy study, whose cylinders are exact.
    Reference: |setting| setting.name != "cylinders", Methods::One("sah-cut"),
        ["samples-per-pixel" = "8"];
    /// The settings that a study of measures does not vary.
    Studied: |setting| {
        ["cylinders", "precision", "threads"].contains(&setting.name)
    }, Methods::Paper, ["precision" = "auto"];
    /// The settings that a search for the best tree does not try.
    Tuned: |setting| !["method", "d-max", "n-oilf"].contains(&setting.name), Methods::Searched, [];
}

/// The settings given on the command line.
#[derive(Clone, Debug)]
pub struct SettingArgs<O> {
    given: Vec<(&'static str, String)>,
    methods: Vec<Method>,
    constants: Vec<(String, f64)>,
    offer: PhantomData<O>,
}

impl<O: Offer> SettingArgs<O> {
    /// Returns whether no setting was given.
    pub fn is_empty(&self) -> bool {
        self.given.is_empty() && self.methods.is_empty() && self.constants.is_empty()
    }

    /// Returns the chosen methods, or the default methods of the command.
    pub fn methods(&self) -> Vec<Method> {
        match self.methods.as_slice() {
            [] => O::methods().list(),
            chosen => chosen.to_vec(),
        }
    }

    /// Returns a setup per method for a scene argument.
    pub fn setups(&self, scene: &str) -> Result<Vec<Setup>> {
        self.setups_for(scene, &self.methods())
    }

    /// Returns a setup for each of these methods.
    pub fn setups_for(&self, scene: &str, methods: &[Method]) -> Result<Vec<Setup>> {
        let mut setup = Setup::new(SceneRequest {
            source: SceneSource::parse(scene),
            ..Setup::default().scene
        });
        let mut edits = Edits::default();
        for setting in SETTINGS.iter().filter(|s| O::has(s)) {
            if let Some(default) = O::default(setting) {
                edits.push(setting.name, default);
            }
        }
        for (name, value) in &self.given {
            edits.push(*name, value);
        }
        // Values that have the wrong form were refused when they were read.
        setup = edits
            .apply(&setup)
            .map_err(|reason| anyhow!("--{reason}"))?;
        for (name, _) in &self.constants {
            let has = |m: &Method| m.constants.iter().any(|c| c.name == name);
            if !methods.iter().any(has) {
                let methods: Vec<_> = methods.iter().map(|m| m.name).collect();
                bail!(
                    "--set {name}: no chosen method ({}) has this setting; see 'bspscope methods'",
                    methods.join(", ")
                );
            }
        }
        let of_method = |&method: &Method| {
            let mut setup = setup.clone();
            setup.build.method = method;
            for (name, value) in &self.constants {
                if method.constants.iter().any(|c| c.name == name) {
                    setup.build.constants.insert(name.clone(), *value);
                }
            }
            setup.build.check()?;
            Ok(setup)
        };
        methods.iter().map(of_method).collect()
    }

    /// Returns the setup of the first method for a scene argument.
    pub fn setup(&self, scene: &str) -> Result<Setup> {
        Ok(self.setups(scene)?.remove(0))
    }
}

impl<O: Offer> FromArgMatches for SettingArgs<O> {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, Error> {
        let offered = || SETTINGS.iter().filter(|s| O::has(s));
        let has_method = offered().any(|s| s.name == "method");
        let text = |s: &'static Setting| Some((s.name, matches.get_one::<String>(s.name)?.clone()));
        let mut methods = Vec::new();
        if has_method {
            methods.extend(
                matches
                    .get_many::<Method>("method")
                    .into_iter()
                    .flatten()
                    .copied(),
            );
        }
        let mut constants = Vec::new();
        if sets_constants::<O>() {
            constants.extend(
                matches
                    .get_many::<(String, f64)>("set")
                    .into_iter()
                    .flatten()
                    .cloned(),
            );
        }
        Ok(SettingArgs {
            given: offered()
                .filter(|s| s.name != "method")
                .filter_map(text)
                .collect(),
            methods,
            constants,
            offer: PhantomData,
        })
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), Error> {
        *self = SettingArgs::from_arg_matches(matches)?;
        Ok(())
    }
}

/// Returns whether a command has the settings of build methods.
fn sets_constants<O: Offer>() -> bool {
    !matches!(O::methods(), Methods::Searched)
        && SETTINGS.iter().any(|s| O::has(s) && s.name == "overlap")
}

impl<O: Offer> Args for SettingArgs<O> {
    fn augment_args(mut command: Command) -> Command {
        for setting in SETTINGS.iter().filter(|s| O::has(s)) {
            command = command.arg(match setting.name {
                "method" => method_arg::<O>(),
                _ => option::<O>(setting),
            });
        }
        if sets_constants::<O>() {
            let set = Arg::new("set")
                .long("set")
                .value_name("NAME=VALUE")
                .value_parser(constant)
                .action(ArgAction::Append)
                .help_heading(Group::Structure.title())
                .help(
                    "A setting of a build method (see 'bspscope methods'), for every chosen method \
                     that has it. Can be repeated",
                );
            command = command.arg(set);
        }
        command
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

fn method_arg<O: Offer>() -> Arg {
    let methods = O::methods();
    let mut about = methods.about().to_owned();
    let action = match methods {
        Methods::One(name) => {
            about += &format!(" [default: {name}]");
            ArgAction::Set
        }
        _ => ArgAction::Append,
    };
    Arg::new("method")
        .long("method")
        .value_name("METHOD")
        .visible_alias("tree")
        .value_parser(MethodParser)
        .action(action)
        .help_heading(Group::Structure.title())
        .help(about)
}

/// Returns the option of a setting.
fn option<O: Offer>(setting: &'static Setting) -> Arg {
    let plain = setting.value(&Setup::default()).to_string();
    let default = O::default(setting).map_or(plain, str::to_owned);
    let symbol = setting
        .symbol
        .map_or_else(String::new, |s| format!(" ({s})"));
    Arg::new(setting.name)
        .long(setting.name)
        .aliases(setting.aliases)
        .value_name(value_name(setting))
        .value_parser(parser(setting))
        .allow_hyphen_values(matches!(setting.kind, Kind::Point))
        .allow_negative_numbers(true)
        .help_heading(setting.group.title())
        .help(format!("{}{symbol} [default: {default}]", setting.about))
}

fn parser(setting: &'static Setting) -> ValueParser {
    match setting.kind {
        Kind::Choice(choices) => {
            let names = choices().into_iter().map(|choice| {
                let name = PossibleValue::new(choice.name).aliases(choice.old_name);
                if choice.about.is_empty() {
                    name
                } else {
                    name.help(choice.about)
                }
            });
            PossibleValuesParser::new(names).into()
        }
        _ => ValueParser::new(|text: &str| setting.read(text).map(|_| text.to_owned())),
    }
}

fn value_name(setting: &Setting) -> &'static str {
    match setting.kind {
        Kind::Number(range) if !range.unit.is_empty() => "N",
        Kind::Number(range) if range.whole => "N",
        Kind::Depth | Kind::Switch | Kind::Automatic(_) => "N",
        Kind::Number(_) => "X",
        Kind::Angle(_) => "DEGREES",
        Kind::Point => "X,Y,Z",
        Kind::Size => "WxH",
        Kind::Choice(_) | Kind::Method => "NAME",
        Kind::Cylinders => "HOW",
    }
}
