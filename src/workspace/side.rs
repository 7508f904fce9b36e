//! A setup in the file: a table of its settings by name.
//!
//! Version 1 had separate tables for the settings of the tree and of the picture and for the
//! camera, with different names. It is read, too.

use crate::setup::{SETTINGS, Setting, Setup, Value, any_setting, setting};
use serde::de::{DeserializeSeed, Error, MapAccess, Visitor};
use serde::ser::SerializeMap;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// A setup without its scene, which is elsewhere in the file.
pub struct Side(pub Setup);

/// Names of the near plane in cameras of version 1. It is ignored, because it belongs to the scene.
const NEAR_PLANE: [&str; 2] = ["hither", "near"];

impl Serialize for Side {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        for setting in self.0.settings() {
            let (value, is_constant) = (setting.value(&self.0), is_constant(&setting));
            if value != Value::Own && !(is_constant && setting.is_default(&self.0)) {
                map.serialize_entry(setting.name, &Written(value))?;
            }
        }
        map.end()
    }
}

/// Returns whether a setting is a constant of a build method.
fn is_constant(setting: &Setting) -> bool {
    SETTINGS.iter().all(|known| known.name != setting.name)
}

/// A value in its natural form: a number, text, or a list of numbers.
struct Written(Value);

impl Serialize for Written {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self.0 {
            Value::Number(number) if number.fract() == 0.0 && number.abs() < 9e15 => {
                serializer.serialize_i64(number as i64)
            }
            Value::Number(number) => serializer.serialize_f64(number),
            Value::Switch(on) => serializer.serialize_bool(on),
            Value::Size(size) => size.serialize(serializer),
            Value::Point(point) => point.to_array().serialize(serializer),
            Value::Depth(depth) => depth.serialize(serializer),
            Value::Choice(_) | Value::Cylinders(_) | Value::Own | Value::Automatic => {
                serializer.collect_str(&self.0)
            }
        }
    }
}

impl<'de> Deserialize<'de> for Side {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let Settings(pairs) = Settings::deserialize(deserializer)?;
        let mut setup = Setup::default();
        set(&mut setup, pairs).map_err(D::Error::custom)?;
        Ok(Side(setup))
    }
}

/// The camera of version 1, which both setups share.
pub struct OldCamera(Vec<(String, Value)>);

impl OldCamera {
    /// Copies the camera to the setup.
    pub fn set(&self, setup: &mut Setup) -> Result<(), String> {
        set(setup, self.0.clone())
    }
}

impl<'de> Deserialize<'de> for OldCamera {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let Settings(mut pairs) = Settings::deserialize(deserializer)?;
        // Version 1 had the scene's own resolution beside the view.
        pairs.retain(|(name, _)| name != "resolution");
        Ok(OldCamera(pairs))
    }
}

/// Stores settings, the method first, because its constants depend on it.
fn set(setup: &mut Setup, mut pairs: Vec<(String, Value)>) -> Result<(), String> {
    pairs.sort_by_key(|(name, _)| name != "method");
    for (name, value) in pairs {
        setup.setting(&name)?.store(setup, value);
    }
    Ok(())
}

/// Settings by name.
struct Settings(Vec<(String, Value)>);

impl<'de> Deserialize<'de> for Settings {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Table::All.deserialize(deserializer)
    }
}

/// A table of settings. In version 1, some were in separate tables, with names that other settings
/// have elsewhere.
#[derive(Clone, Copy)]
enum Table {
    All,
    Picture,
    Constants,
}

impl Table {
    /// Returns the nested table with this name.
    fn within(name: &str) -> Option<Table> {
        match name {
            "tree" => Some(Table::All),
            "picture" => Some(Table::Picture),
            "constants" => Some(Table::Constants),
            _ => None,
        }
    }

    fn setting(self, name: &str) -> Result<Setting, String> {
        let general = setting(name).filter(|_| !matches!(self, Table::Constants));
        match general.filter(|s| s.name == name || matches!(self, Table::Picture)) {
            Some(setting) => Ok(*setting),
            None => any_setting(name),
        }
    }
}

impl<'de> DeserializeSeed<'de> for Table {
    type Value = Settings;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Settings, D::Error> {
        deserializer.deserialize_map(self)
    }
}

impl<'de> Visitor<'de> for Table {
    type Value = Settings;

    fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("a table of settings")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Settings, A::Error> {
        let mut pairs = Vec::new();
        while let Some(key) = map.next_key_seed(KeyIn(self))? {
            match key {
                Key::Table(table) => pairs.extend(map.next_value_seed(table)?.0),
                Key::NearPlane => {
                    map.next_value::<serde::de::IgnoredAny>()?;
                }
                Key::Bytes => {
                    let bytes: u64 = map.next_value()?;
                    let mib = (bytes >> 20).max(1);
                    pairs.push(("memory-limit".into(), Value::Number(mib as f64)));
                }
                Key::Setting(setting) => {
                    let value = map.next_value_seed(ValueOf(setting))?;
                    pairs.push((setting.name.to_owned(), value));
                }
            }
        }
        Ok(Settings(pairs))
    }
}

/// Parses a value of a setting.
struct ValueOf(Setting);

impl<'de> DeserializeSeed<'de> for ValueOf {
    type Value = Value;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Value, D::Error> {
        let written = toml::Value::deserialize(deserializer)?;
        let text = match &written {
            toml::Value::String(text) => text.clone(),
            toml::Value::Boolean(on) => u8::from(*on).to_string(),
            toml::Value::Array(parts) => {
                let separator = if parts.len() == 2 { "x" } else { "," };
                let parts: Vec<_> = parts.iter().map(ToString::to_string).collect();
                parts.join(separator)
            }
            other => other.to_string(),
        };
        self.0
            .parse(&text)
            .map_err(|reason| D::Error::custom(format!("{}: {reason}", self.0.name)))
    }
}

/// What a key of a table stands for.
enum Key {
    Table(Table),
    Setting(Setting),
    /// The memory limit of version 1, in bytes.
    Bytes,
    NearPlane,
}

/// Reads a key of a table. An unknown key is reported with its line.
struct KeyIn(Table);

impl<'de> DeserializeSeed<'de> for KeyIn {
    type Value = Key;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Key, D::Error> {
        let name = String::deserialize(deserializer)?;
        if let Some(table) = Table::within(&name) {
            return Ok(Key::Table(table));
        }
        if name == "memory_limit" {
            return Ok(Key::Bytes);
        }
        if NEAR_PLANE.contains(&name.as_str()) {
            return Ok(Key::NearPlane);
        }
        let setting = self.0.setting(&name.replace('_', "-"));
        setting.map(Key::Setting).map_err(D::Error::custom)
    }
}
