//! Build methods by name, from the registry.

use super::bvh::BVH_BUILDERS;
use super::settings::{BuildSettings, Method, SettingsError};
use super::split::SPLIT_RULES;
use super::tree_file::{is_tree_file, of_file};
use serde::{Deserialize, Deserializer};

impl Method {
    /// Returns all methods in the order of their registries.
    pub fn all() -> impl Iterator<Item = Method> {
        SPLIT_RULES.iter().chain(BVH_BUILDERS).map(Method::new)
    }

    /// Returns all methods by the family of their structure ([`super::method::Structure::family`]). Families
    /// and the methods of each are in the order of the registries.
    pub fn families() -> Vec<(&'static str, Vec<Method>)> {
        let mut families: Vec<(&str, Vec<Method>)> = Vec::new();
        for method in Method::all() {
            let family = method.structure.family();
            match families.iter_mut().find(|(known, _)| *known == family) {
                Some((_, methods)) => methods.push(method),
                None => families.push((family, vec![method])),
            }
        }
        families
    }

    /// Returns the method with this name, or the one that reads a tree file (`.bstree`) at this path.
    ///
    /// # Errors
    /// The name is neither in the registry nor a tree file's.
    pub fn named(name: &str) -> Result<Method, SettingsError> {
        if is_tree_file(name) {
            return Ok(of_file(name));
        }
        Method::all()
            .find(|m| m.name == name)
            .ok_or_else(|| SettingsError::UnknownMethod {
                found: name.to_owned(),
                known: Method::all().map(|m| m.name).collect::<Vec<_>>().join(", "),
            })
    }

    /// Returns the two methods of the paper, 1 then 2.
    pub fn of_the_paper() -> Vec<Method> {
        Method::all().filter(|m| m.paper.is_some()).collect()
    }
}

impl std::str::FromStr for Method {
    type Err = SettingsError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        Method::named(text)
    }
}

impl<'de> Deserialize<'de> for Method {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let name = String::deserialize(deserializer)?;
        Method::named(&name).map_err(serde::de::Error::custom)
    }
}

impl Default for BuildSettings {
    fn default() -> Self {
        BuildSettings::for_method(Method::new(&SPLIT_RULES[0]))
    }
}
