//! Settings by name, and what to say if there is none.

use super::setting::{Affects, Group, Setting};
use super::{SETTINGS, Setup};
use crate::structure::Method;
use crate::structure::split::Structure;

/// The setting of this name or alias, the constants of build methods left out.
pub fn setting(name: &str) -> Option<&'static Setting> {
    SETTINGS.iter().find(|setting| setting.is_called(name))
}

/// The setting of this name that some method or every setup has.
///
/// # Errors
/// There is none. The message lists all settings and suggests the nearest name.
pub fn any_setting(name: &str) -> Result<Setting, String> {
    let of_constant = constants().find(|s| s.name == name);
    of_constant
        .or_else(|| setting(name).copied())
        .ok_or_else(|| no_setting(name))
}

/// The constants of all methods, as settings. Several methods can have one of the same name.
fn constants() -> impl Iterator<Item = Setting> {
    Method::all().flat_map(|m| m.info().constants.iter().map(Setting::of_constant))
}

impl Setup {
    /// All settings that apply: [`SETTINGS`] in their order, after those of the structure the
    /// constants of the method.
    pub fn settings(&self) -> impl Iterator<Item = Setting> + use<> {
        let method = self.build.method;
        let of_group = |group| move |s: &Setting| s.group == group;
        let (scene, structure) = (of_group(Group::Scene), of_group(Group::Structure));
        let all = || SETTINGS.iter().copied();
        all()
            .filter(scene)
            .chain(all().filter(structure))
            .chain(method.info().constants.iter().map(Setting::of_constant))
            .chain(all().filter(|s| matches!(s.group, Group::Picture | Group::Camera)))
    }

    /// Whether a setting has an effect with this method. Grids have no depth and no leaf size, and a bounding
    /// volume hierarchy has neither cells nor planes.
    pub fn applies(&self, setting: &Setting) -> bool {
        let (structure, has_limits) = (self.build.method.structure, self.build.method.has_limits);
        match setting.name {
            "d-max" | "n-oilf" => has_limits,
            "first-axis" | "overlap" if self.build.method.is_file() => false,
            "first-axis" => matches!(structure, Structure::Bintree | Structure::Octree),
            "overlap" => structure != Structure::Bvh,
            _ => true,
        }
    }

    /// The setting of this name: a constant of the method, or one of [`SETTINGS`] by its name or
    /// alias.
    ///
    /// # Errors
    /// There is none. The message lists all settings and suggests the nearest name.
    pub fn setting(&self, name: &str) -> Result<Setting, String> {
        let by_name = || self.settings().find(|s| s.name == name);
        by_name()
            .or_else(|| self.settings().find(|s| s.is_called(name)))
            .ok_or_else(|| {
                let owners = owners(name);
                if owners.is_empty() {
                    no_setting(name)
                } else {
                    let (method, owners) = (self.build.method.name, owners.join(", "));
                    format!("no setting '{name}' in method {method}; only in {owners}")
                }
            })
    }

    /// Returns what this setup invalidates of the results of another one, and with it everything
    /// that comes later in [`Affects`]. `None` if the setups are equal.
    pub fn invalidates(&self, other: &Setup) -> Option<Affects> {
        if self.scene.source != other.scene.source {
            return Some(Affects::Scene);
        }
        let is_same_method = self.build.method == other.build.method;
        let is_comparable =
            |s: &Setting| is_same_method || SETTINGS.iter().any(|known| known.name == s.name);
        self.settings()
            .filter(is_comparable)
            .filter(|s| s.value(self) != s.value(other))
            .map(|s| s.affects)
            .min()
    }

    /// Whether this setup's picture can differ from another one's: another scene, or another value of a
    /// setting that affects the image. All structures and kernels render the same picture.
    pub fn alters_picture(&self, other: &Setup) -> bool {
        let decides = |s: &&Setting| matches!(s.affects, Affects::Scene | Affects::Image);
        let mut deciding = SETTINGS.iter().filter(decides);
        self.scene.source != other.scene.source || deciding.any(|s| s.value(self) != s.value(other))
    }
}

/// The methods that have a constant of this name.
fn owners(constant: &str) -> Vec<&'static str> {
    let has = |m: &Method| m.info().constants.iter().any(|c| c.name == constant);
    Method::all().filter(has).map(|m| m.name).collect()
}

/// The message for an unknown name.
fn no_setting(name: &str) -> String {
    let meant = match nearest(name) {
        Some(near) => format!("; did you mean '{near}'?"),
        None => ".".to_owned(),
    };
    let general: Vec<_> = SETTINGS.iter().map(|s| s.name).collect();
    let of_methods = Method::all().filter(|m| !m.constants.is_empty()).map(|m| {
        let names: Vec<_> = m.constants.iter().map(|c| c.name).collect();
        format!("{}: {}", m.name, names.join(", "))
    });
    let of_methods = of_methods.collect::<Vec<_>>().join("; ");
    format!(
        "no setting '{name}'{meant} There are {}; of {of_methods}",
        general.join(", ")
    )
}

/// The setting whose name, alias, symbol or label is nearest to this name, if one is near.
fn nearest(name: &str) -> Option<&'static str> {
    let plain = |text: &str| text.to_lowercase().replace(['_', ' '], "-");
    let wanted = plain(name);
    let distance = |s: Setting| {
        let names = [s.name, s.label].into_iter().chain(s.symbol);
        let names = names.chain(s.aliases.iter().copied());
        let edits = names.map(|known| edits_between(&plain(known), &wanted));
        Some((edits.min()?, s.name))
    };
    let all = SETTINGS.iter().copied().chain(constants());
    let (edits, near) = all.filter_map(distance).min()?;
    (edits <= name.chars().count().div_ceil(4)).then_some(near)
}

/// The least number of inserted, removed and replaced letters that turn one text into the other
/// (Levenshtein distance). Too little for a crate.
fn edits_between(from: &str, to: &str) -> usize {
    let to: Vec<char> = to.chars().collect();
    let mut row: Vec<usize> = (0..=to.len()).collect();
    for (i, a) in from.chars().enumerate() {
        let mut before = std::mem::replace(&mut row[0], i + 1);
        for (j, b) in to.iter().enumerate() {
            let replaced = before + usize::from(a != *b);
            before = row[j + 1];
            row[j + 1] = replaced.min(before + 1).min(row[j] + 1);
        }
    }
    row[to.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn near_names_are_suggested() {
        for (wrong, meant) in [
            ("dmax", "d-max"),
            ("D_MAX", "d-max"),
            ("d_max", "d-max"),
            ("thrads", "threads"),
            ("Leaf size", "n-oilf"),
            ("cutoff", "min-contribution"),
            ("gap-fracton", "gap-fraction"),
        ] {
            assert_eq!(nearest(wrong), Some(meant), "{wrong}");
            let message = any_setting(wrong).err().unwrap();
            let start = format!("no setting '{wrong}'; did you mean '{meant}'?");
            assert!(message.starts_with(&start), "{message}");
        }
        for wrong in ["", "x", "colour", "banana"] {
            assert_eq!(nearest(wrong), None, "{wrong}");
        }
    }

    #[test]
    fn an_unknown_name_is_answered_with_all_settings() {
        let message = Setup::default().setting("colour").err().unwrap();
        for setting in SETTINGS.iter().copied().chain(constants()) {
            assert!(message.contains(setting.name), "{message}");
        }
        let other = Setup::default().setting("gap-fraction").err().unwrap();
        assert_eq!(
            other,
            "no setting 'gap-fraction' in method midpoint; only in sah-cut"
        );
    }

    #[test]
    fn edits_are_counted() {
        for (from, to, edits) in [
            ("", "", 0),
            ("", "abc", 3),
            ("kitten", "sitting", 3),
            ("abc", "abc", 0),
            ("abc", "ac", 1),
        ] {
            assert_eq!(edits_between(from, to), edits, "{from} {to}");
            assert_eq!(edits_between(to, from), edits, "{to} {from}");
        }
    }
}
