//! The values of settings that are one of several names.

use super::setting::Choice;
use crate::geometry::Axis;
use crate::scene::Sampling;
use crate::structure::{Method, OverlapRule};
use crate::trace::{KernelChoice, PrecisionChoice};

fn choice(name: &'static str, about: &'static str) -> Choice {
    Choice {
        name,
        old_name: None,
        about,
        group: "",
    }
}

pub fn methods() -> Vec<Choice> {
    let of_family = |(group, methods): (&'static str, Vec<Method>)| {
        methods.into_iter().map(move |method| Choice {
            group,
            ..choice(method.info().name, method.info().summary)
        })
    };
    Method::families().into_iter().flat_map(of_family).collect()
}

pub fn axes() -> Vec<Choice> {
    Axis::ALL.map(|axis| choice(axis.name(), "")).to_vec()
}

pub fn overlaps() -> Vec<Choice> {
    let about = |rule| match rule {
        OverlapRule::Paper => {
            "As in the paper: midpoint tests spheres exactly and all others by their bounds, sah-cut \
             tests all by their bounds"
        }
        OverlapRule::Bounds => "When its bounding box touches the cell",
        OverlapRule::Exact => "When it shares a point with the cell",
    };
    let all = OverlapRule::ALL;
    all.map(|rule| choice(rule.name(), about(rule))).to_vec()
}

pub fn samplings() -> Vec<Choice> {
    let about = |sampling| match sampling {
        Sampling::Center => "At the pixel's center",
        Sampling::Corner => "On a lattice whose first and last samples span the angle of view",
    };
    let all = Sampling::ALL;
    all.map(|sampling| choice(sampling.name(), about(sampling)))
        .to_vec()
}

pub fn precisions() -> Vec<Choice> {
    let about = |precision| match precision {
        PrecisionChoice::F32 => "Single precision",
        PrecisionChoice::F64 => "Double precision",
        PrecisionChoice::Auto => {
            "f32 if it can represent the scene as the camera sees it, else f64"
        }
    };
    let all = PrecisionChoice::ALL;
    all.map(|precision| choice(precision.name(), about(precision)))
        .to_vec()
}

pub fn kernels() -> Vec<Choice> {
    let about = |kernel| match kernel {
        KernelChoice::Scalar => {
            "One ray after the other, as in the paper, through exactly the nodes that are counted"
        }
        KernelChoice::Stream => "SIMD streams of rays, each with its own traversal",
        KernelChoice::Packets => "SIMD packets of rays that traverse together",
        KernelChoice::Auto => {
            "Packets where rays are coherent, else streams; scalar on processors without wide SIMD"
        }
    };
    let choice = |kernel: KernelChoice| Choice {
        name: kernel.name(),
        old_name: kernel.old_name(),
        about: about(kernel),
        group: "",
    };
    KernelChoice::ALL.map(choice).to_vec()
}
