//! The settings that exchange accuracy for speed. A knob is the name of a setting with a function
//! that returns its cheaper values. It is one line in [`KNOBS`].

use crate::scene::{Cylinders, Scene};
use crate::setup::{Affects, Setting, Setup, Value, setting};
use crate::structure::{MaxDepth, Method};
use crate::trace::KernelChoice;

/// A setting that changes the rendering time.
#[derive(Debug)]
pub struct Knob {
    /// Name of the setting.
    setting: &'static str,
    /// Returns the alternatives to the reference's value, from expensive to cheap. The scene has
    /// exact cylinders. Empty if the setting has no effect on the scene.
    values: fn(&Setup, &Scene) -> Vec<Value>,
}

const fn knob(setting: &'static str, values: fn(&Setup, &Scene) -> Vec<Value>) -> Knob {
    Knob { setting, values }
}

/// All knobs, in the order in which reports list them.
pub static KNOBS: &[Knob] = &[
    knob("precision", |_, _| vec![Value::Choice("f32")]),
    knob("samples-per-pixel", samples),
    knob("d-arec", d_arec),
    knob("min-contribution", min_contribution),
    knob("cylinders", cylinders),
    knob("resolution", resolution),
    knob("kernel", kernel),
    knob("method", method),
    knob("d-max", |_, _| {
        [12, 16, 24]
            .map(|d| Value::Depth(MaxDepth::Fixed(d)))
            .to_vec()
    }),
    knob("n-oilf", |_, _| [1.0, 4.0, 8.0].map(Value::Number).to_vec()),
];

impl Knob {
    pub fn setting(&self) -> &'static Setting {
        setting(self.setting).expect("a test walks all knobs")
    }

    /// Returns one or two words, such as `samples` or `D_AREC`.
    pub fn name(&self) -> String {
        self.setting().word()
    }

    /// Returns whether the setting changes the image, not only its time.
    pub fn moves_image(&self) -> bool {
        matches!(self.setting().affects, Affects::Scene | Affects::Image)
    }

    /// Returns every other value at a reference: its text, and the resulting setup.
    pub fn choices(&self, at: &Setup, scene: &Scene) -> Vec<(String, Setup)> {
        let setting = self.setting();
        let values = (self.values)(at, scene).into_iter();
        values
            .filter(|value| *value != setting.value(at))
            .map(|value| {
                let mut setup = at.clone();
                setting.store(&mut setup, value);
                (value.to_string(), setup)
            })
            .collect()
    }
}

fn samples(at: &Setup, _: &Scene) -> Vec<Value> {
    let fewer = [at.render.samples / 4, 1];
    let fewer = fewer.into_iter().enumerate();
    fewer
        .filter(|&(i, samples)| samples < at.render.samples && samples > u32::from(i == 0))
        .map(|(_, samples)| Value::Number(f64::from(samples)))
        .collect()
}

fn d_arec(at: &Setup, scene: &Scene) -> Vec<Value> {
    let deepest = scene.requirements().secondary_depth(at.render.d_arec);
    let depths = [4, 2, 1, 0].into_iter().filter(|&depth| depth < deepest);
    depths
        .map(|depth| Value::Number(f64::from(depth)))
        .collect()
}

fn min_contribution(at: &Setup, scene: &Scene) -> Vec<Value> {
    if scene.requirements().secondary_depth(at.render.d_arec) == 0 {
        return Vec::new();
    }
    [0.01, 0.05, 0.2].map(Value::Number).to_vec()
}

fn cylinders(_: &Setup, scene: &Scene) -> Vec<Value> {
    use crate::primitive::PrimitiveKind::Cone;
    let primitives = &scene.requirements().primitives;
    if primitives.iter().all(|&(kind, _)| kind != Cone) {
        return Vec::new();
    }
    let sides = [64, 20, 10, 6];
    sides
        .map(|n| Value::Cylinders(Cylinders::Polygons(n)))
        .to_vec()
}

fn resolution(at: &Setup, _: &Scene) -> Vec<Value> {
    let sides = [at.render.width, at.render.height];
    let smaller = [2, 4].map(|by| sides.map(|side| side.div_ceil(by)));
    smaller.map(Value::Size).to_vec()
}

fn kernel(at: &Setup, _: &Scene) -> Vec<Value> {
    let kernels = [
        KernelChoice::Scalar,
        KernelChoice::Stream,
        KernelChoice::Packets,
    ];
    let others = kernels
        .into_iter()
        .filter(|k| k.simd() != at.render.kernel.simd());
    others.map(|kernel| Value::Choice(kernel.name())).collect()
}

fn method(_: &Setup, _: &Scene) -> Vec<Value> {
    let names = Method::all().map(|m| m.info().name);
    names
        .filter(|name| *name != "none")
        .map(Value::Choice)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn knobs_are_settings() {
        assert!(KNOBS.len() > 5);
        for knob in KNOBS {
            assert_eq!(knob.setting().name, knob.setting);
        }
    }
}
