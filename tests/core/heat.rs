//! Heatmaps: the whole picture's value is the parameter's; scales, ticks and colours tell the truth.

use crate::support::scenes::{render_sized, scene_file, tree_by};
use bspscope::measure::heat::{
    HeatImage, Heatmap, PixelCounts, RayFilter, Source, heatmap, heatmaps,
};
use bspscope::measure::{Measurement, Times, parameter};
use bspscope::present::overlay::{
    COLORMAPS, Captions, Colormap, HeatPicture, HeatScale, Range, Scale, blend, colormap,
    heat_colors, with_legend,
};
use bspscope::progress::Progress;
use bspscope::scene::Scene;
use bspscope::structure::Tree;
use bspscope::trace::{RenderSettings, pixel_times, record_pixel, render_counted, thread_pool};
use std::sync::Mutex;
use std::time::Instant;

const SCENES: [&str; 4] = ["balls", "rings", "tetra", "teaching"];

/// Not a multiple of a tile, and wider than high.
const SIZE: [u32; 2] = [75, 50];

fn small(scene: &Scene) -> RenderSettings {
    render_sized(scene, SIZE)
}

/// Counts of every pixel, with the measurement from the same pass.
fn counted(scene: &Scene, tree: &Tree) -> (PixelCounts, Measurement) {
    let settings = small(scene);
    let mut measurement = Measurement::of_tree(scene, tree, Times::default(), &settings);
    let counts = Mutex::new(PixelCounts::new(settings.width, settings.height));
    let pool = thread_pool(0).unwrap();
    let pass = render_counted(scene, tree, &settings, &pool, &Progress::new(), |part| {
        counts.lock().unwrap().add(&part);
    });
    measurement.counted = Some(pass.unwrap());
    (counts.into_inner().unwrap(), measurement)
}

fn one(symbol: &str) -> &'static Heatmap {
    heatmap(symbol).unwrap()
}

fn map(name: &str) -> &'static Colormap {
    colormap(name).unwrap()
}

fn image(values: &[f32]) -> HeatImage {
    HeatImage {
        width: values.len() as u32,
        height: 1,
        values: values.to_vec(),
        grain: 1.0,
    }
}

fn automatic(image: &HeatImage, scale: Scale) -> HeatScale {
    HeatScale::new(image, scale, Range::Automatic, map("viridis")).unwrap()
}

#[test]
fn the_whole_pictures_value_is_the_parameters() {
    let mut equalities = 0;
    for name in SCENES {
        let scene = scene_file(name);
        for method in ["midpoint", "sah-cut"] {
            let tree = tree_by(&scene, method);
            let (counts, measurement) = counted(&scene, &tree);
            for heatmap in heatmaps() {
                for (rays, symbols) in &heatmap.totals {
                    let values: Vec<_> = symbols
                        .iter()
                        .map(|symbol| parameter(symbol).value(&measurement).unwrap())
                        .collect();
                    assert_eq!(
                        heatmap.total(&counts, *rays),
                        Some(values.iter().sum()),
                        "{name}, {method}, {}, {} rays",
                        heatmap.symbol,
                        rays.name()
                    );
                    equalities += 1;
                }
            }
            for (symbol, sum_of) in [
                ("N_IT", "N_PRIT"),
                ("N_RAYS", "N_PR"),
                ("N_NODES", "N_NODES"),
            ] {
                // Added up here, pixel by pixel, as a picture of raw values is.
                let rays = if symbol == "N_NODES" {
                    RayFilter::All
                } else {
                    RayFilter::Primary
                };
                let image = one(symbol).image(&counts, rays);
                let sum: f64 = image.present().sum();
                assert_eq!(Some(sum), parameter(sum_of).value(&measurement), "{symbol}");
                assert!(sum > 0.0);
            }
            let depths = one("D_COMPX").image(&counts, RayFilter::All);
            assert_eq!(
                depths.statistics().map(|s| s.mean),
                parameter("D_COMPX").value(&measurement)
            );
        }
    }
    // Seven that the paper has for all rays and box tests, and two for all and each of its three kinds.
    assert_eq!(equalities, SCENES.len() * 2 * (8 + 2 * 4));
}

#[test]
fn kinds_of_rays_add_up_to_all_and_each_comes_from_its_own_tally() {
    // Only tetra's rays are all primary or shadow rays; balls reflects, teaching also refracts.
    let scene = scene_file("teaching");
    let of_method = |method| counted(&scene, &tree_by(&scene, method)).0;
    let (planes, boxes) = (of_method("sah-cut"), of_method("bvh-sweep"));
    for heatmap in heatmaps() {
        assert_eq!(heatmap.filters()[0], RayFilter::All);
        if heatmap.filters().len() == 1 || heatmap.symbol == "N_RPRT" {
            continue;
        }
        let counts = if heatmap.symbol == "N_BT" {
            &boxes
        } else {
            &planes
        };
        let total = |rays| heatmap.total(counts, rays).unwrap();
        let parts = [
            RayFilter::Primary,
            RayFilter::Shadow,
            RayFilter::Reflected,
            RayFilter::Refracted,
        ]
        .map(total);
        assert!(parts.iter().all(|&part| part > 0.0), "{}", heatmap.symbol);
        assert_eq!(parts.iter().sum::<f64>(), total(RayFilter::All));
        assert_eq!(parts[2] + parts[3], total(RayFilter::Secondary));
    }
    let rays = |filter| one("N_RAYS").total(&planes, filter);
    assert_eq!(rays(RayFilter::Primary), Some(f64::from(SIZE[0] * SIZE[1])));
}

#[test]
fn a_pixels_values_are_those_of_its_record() {
    let scene = scene_file("balls");
    let tree = tree_by(&scene, "midpoint");
    let (counts, _) = counted(&scene, &tree);
    let settings = small(&scene);
    for (x, y) in [(0, 0), (37, 25), (74, 49), (33, 40), (40, 33)] {
        let record = record_pixel(&scene, &tree, &settings, [x, y]).unwrap();
        let tests: u32 = record.rays.iter().map(|ray| ray.path.counts().tests).sum();
        let image = one("N_IT").image(&counts, RayFilter::All);
        assert_eq!(image.get(x, y), Some(tests as f32), "{x}, {y}");
        let hits = record.rays.iter().filter(|r| r.path.hit.is_hit()).count();
        let pixel = (y * SIZE[0] + x) as usize;
        let expected = (hits > 0).then(|| f64::from(tests) / hits as f64);
        assert_eq!(
            one("N_RPRT").value(&counts, pixel, RayFilter::All),
            expected
        );
    }
    let image = one("N_IT").image(&counts, RayFilter::All);
    assert_eq!(image.get(SIZE[0], 0), None);
    assert_eq!(image.get(0, SIZE[1]), None);
}

#[test]
fn every_entry_has_words_and_a_symbol_of_its_own() {
    assert!(heatmaps().len() >= 10);
    for (i, one) in heatmaps().iter().enumerate() {
        assert!(heatmaps()[..i].iter().all(|h| h.symbol != one.symbol));
        let found = heatmap(&one.symbol.to_lowercase()).unwrap();
        assert_eq!(found.symbol, one.symbol);
        for words in [one.name, one.unit, one.meaning] {
            assert!(!words.is_empty(), "{}", one.symbol);
        }
        assert!(one.grain > 0.0);
        assert!(matches!(one.source, Source::Time) || !one.totals.is_empty());
    }
    assert!(heatmap("N_LS").is_none());
}

#[test]
fn time_is_taken_of_every_pixel_and_only_when_asked_for() {
    let scene = scene_file("teaching");
    let tree = tree_by(&scene, "midpoint");
    let settings = small(&scene);
    let pool = thread_pool(1).unwrap();
    let mut counts = PixelCounts::new(settings.width, settings.height);
    let time = one("T_PIXEL");
    assert_eq!(time.total(&counts, RayFilter::All), None);
    assert_eq!(time.value(&counts, 0, RayFilter::All), None);
    assert_eq!(time.image(&counts, RayFilter::All).statistics(), None);

    let start = Instant::now();
    let seconds = pixel_times(&scene, &tree, &settings, &pool, &Progress::new()).unwrap();
    let whole = start.elapsed().as_secs_f64();
    assert_eq!(seconds.len(), counts.tallies.len());
    assert!(seconds.iter().all(|s| s.is_finite() && *s > 0.0));
    let sum: f64 = seconds.iter().map(|&s| f64::from(s)).sum();
    // One thread, one pixel after the other, however busy the machine is.
    assert!(sum <= whole, "{sum} s of {whole} s");
    counts.seconds = Some(seconds);
    let total = time.total(&counts, RayFilter::All).unwrap();
    assert!((total - sum * 1e6).abs() < 1e-9 * total, "microseconds");
    let cancelled = Progress::new();
    cancelled.cancel();
    assert!(pixel_times(&scene, &tree, &settings, &pool, &cancelled).is_err());
}

#[test]
fn ticks_are_round_ascending_and_within_the_range() {
    let ranges = [
        (0.0, 1.0),
        (1.0, 3.0),
        (63.0, 1981.0),
        (0.0, 1e6),
        (2.0, 1699.0),
        (0.87, 105.0),
        (300.0, 800.0),
        (-14.0, 14.0),
        (-3e5, 3e5),
        (0.001, 0.002),
        (1e12, 3e12),
    ];
    for (lo, hi) in ranges {
        for scale in Scale::ALL {
            for most in [3, 6, 11] {
                let range = Range::Fixed { lo, hi };
                let scale = HeatScale::new(&image(&[0.0]), scale, range, map("viridis")).unwrap();
                let ticks = scale.ticks(most);
                let told = format!("{scale:?}, {most}: {ticks:?}");
                assert!(!ticks.is_empty() && ticks.len() <= most, "{told}");
                assert!(ticks.iter().all(|t| (lo..=hi).contains(&t.value)), "{told}");
                assert!(
                    ticks.is_sorted_by(|a, b| a.value < b.value && a.place < b.place),
                    "{told}"
                );
                assert!(
                    ticks.iter().all(|t| (0.0..=1.0).contains(&t.place)),
                    "{told}"
                );
                for tick in &ticks {
                    let number = tick.text.replace('−', "-").replace('\u{a0}', "");
                    let number: f64 = number.parse().unwrap();
                    assert!(
                        (number - tick.value).abs() <= 1e-9 * tick.value.abs(),
                        "{told}"
                    );
                    assert_eq!(scale.place(tick.value), Some(tick.place));
                }
                let steps: Vec<_> = ticks.windows(2).map(|t| t[1].value - t[0].value).collect();
                if scale.scale == Scale::Linear {
                    for step in steps {
                        let leading = step / 10f64.powf(step.log10().floor() + 1e-9).max(1e-300);
                        let leading = if leading < 0.99 {
                            leading * 10.0
                        } else {
                            leading
                        };
                        let round = [1.0, 2.0, 5.0, 10.0];
                        assert!(
                            round.iter().any(|r| (leading / r - 1.0).abs() < 1e-6),
                            "{told}"
                        );
                    }
                }
            }
        }
    }
}

#[test]
fn counts_have_whole_ticks() {
    let scale = automatic(&image(&[1.0, 2.0, 3.0]), Scale::Linear);
    let texts: Vec<_> = scale.ticks(11).into_iter().map(|t| t.text).collect();
    assert_eq!(texts, ["1", "2", "3"]);
}

#[test]
fn a_logarithmic_scale_has_a_place_for_zero_and_both_signs() {
    let values = image(&[0.0, 1.0, 10.0, 1000.0]);
    let scale = automatic(&values, Scale::Logarithmic);
    let places: Vec<_> = [0.0, 1.0, 10.0, 100.0, 1000.0]
        .map(|v| scale.place(v).unwrap())
        .to_vec();
    assert!(places.is_sorted_by(|a, b| a + 0.05 < *b), "{places:?}");
    assert_eq!((places[0], places[4]), (0.0, 1.0));
    // A factor of ten is the same way everywhere above the grain.
    assert!(((places[3] - places[2]) / (places[4] - places[3]) - 1.0).abs() < 0.1);
    let values: Vec<_> = scale.ticks(6).iter().map(|t| t.value).collect();
    assert_eq!(values, [0.0, 1.0, 10.0, 100.0, 1000.0]);

    let signed = image(&[-10.0, 0.0, 1000.0]);
    let scale = HeatScale::new(
        &signed,
        Scale::Logarithmic,
        Range::Automatic,
        map("blue-red"),
    )
    .unwrap();
    assert_eq!((scale.lo, scale.hi), (-1000.0, 1000.0));
    assert_eq!(scale.place(0.0), Some(0.5));
    let [below, above] = [-10.0, 10.0].map(|v| scale.place(v).unwrap());
    assert!((below + above - 1.0).abs() < 1e-12 && below < 0.4);
}

#[test]
fn all_the_same_and_nothing_at_all() {
    let same = image(&[7.0; 3]);
    for scale in Scale::ALL {
        let scale = automatic(&same, scale);
        assert_eq!(scale.place(7.0), Some(0.5));
        let ticks = scale.ticks(5);
        assert_eq!(ticks.len(), 1);
        assert_eq!((ticks[0].value, ticks[0].place), (7.0, 0.5));
        assert_eq!(scale.histogram(&same, 4).iter().sum::<u64>(), 3);
    }

    for nothing in [image(&[]), image(&[f32::NAN; 3])] {
        let viridis = map("viridis");
        assert_eq!(nothing.statistics(), None);
        let scale = HeatScale::new(&nothing, Scale::Linear, Range::Automatic, viridis);
        assert_eq!(scale, None);
        let colors = heat_colors(&nothing, None, viridis);
        assert_eq!(colors, vec![viridis.no_value(); nothing.values.len()]);
        let range = Range::Fixed { lo: 0.0, hi: 1.0 };
        let scale = HeatScale::new(&nothing, Scale::Linear, range, viridis).unwrap();
        assert_eq!(scale.histogram(&nothing, 4), [0; 4]);
        assert_eq!(scale.place(f64::NAN), None);
    }
    for (lo, hi) in [
        (1.0, 1.0),
        (2.0, 1.0),
        (0.0, f64::INFINITY),
        (f64::NAN, 1.0),
    ] {
        let range = Range::Fixed { lo, hi };
        assert_eq!(
            HeatScale::new(&same, Scale::Linear, range, map("viridis")),
            None
        );
    }
}

#[test]
fn a_locked_range_gives_a_value_the_same_colour_in_every_picture() {
    let (a, b) = (image(&[1.0, 20.0, 500.0]), image(&[0.0, 20.0, 9.0]));
    let range = Range::Fixed { lo: 0.0, hi: 100.0 };
    for scale in Scale::ALL {
        let colors = [&a, &b].map(|image| {
            let scale = HeatScale::new(image, scale, range, map("viridis"));
            heat_colors(image, scale.as_ref(), map("viridis"))
        });
        assert_eq!(colors[0][1], colors[1][1]);
        assert_ne!(colors[0][0], colors[0][1]);
        assert_eq!(colors[0][2], map("viridis").color(1.0), "beyond: the end's");
        assert_eq!(colors[1][0], map("viridis").color(0.0));
    }
    let scale = HeatScale::new(&a, Scale::Linear, range, map("viridis")).unwrap();
    assert_eq!(scale.beyond(&a), [0, 1]);
    assert_eq!(scale.histogram(&a, 10), [1, 0, 1, 0, 0, 0, 0, 0, 0, 1]);
}

#[test]
fn differences_are_pixel_by_pixel_with_their_sign() {
    let (a, b) = (
        image(&[1.0, 5.0, f32::NAN, 2.0]),
        image(&[3.0, 1.0, 1.0, f32::NAN]),
    );
    let difference = a.difference(&b).unwrap();
    assert_eq!(difference.values[..2], [-2.0, 4.0]);
    assert!(difference.values[2].is_nan() && difference.values[3].is_nan());
    assert_eq!(a.difference(&image(&[1.0])), None);
    let diverging = COLORMAPS.iter().find(|map| map.diverging).unwrap();
    let scale = HeatScale::new(&difference, Scale::Linear, Range::Automatic, diverging).unwrap();
    assert_eq!((scale.lo, scale.hi), (-4.0, 4.0));
}

/// Relative luminance of an sRGB colour (IEC 61966-2-1).
fn luminance(color: [u8; 3]) -> f64 {
    let linear = color.map(|v| {
        let v = f64::from(v) / 255.0;
        if v <= 0.04045 {
            v / 12.92
        } else {
            ((v + 0.055) / 1.055).powf(2.4)
        }
    });
    0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]
}

#[test]
fn lightness_alone_tells_the_colours_apart() {
    assert!(!COLORMAPS[0].diverging, "the default");
    assert!(COLORMAPS.iter().any(|map| map.diverging));
    for (i, map) in COLORMAPS.iter().enumerate() {
        assert!(COLORMAPS[..i].iter().all(|m| m.name != map.name));
        assert_eq!(colormap(map.name).map(|m| m.name), Some(map.name));
        let lights: Vec<_> = (0..=20)
            .map(|i| luminance(map.color(f64::from(i) / 20.0)))
            .collect();
        let (first, second) = lights.split_at(10);
        if map.diverging {
            assert!(first.is_sorted_by(|a, b| a < b), "{}", map.name);
            assert!(second.is_sorted_by(|a, b| a > b), "{}", map.name);
            let [low, _, _] = map.color(0.0);
            let [high, _, _] = map.color(1.0);
            assert!(high > low, "{}: the greater is the redder", map.name);
        } else {
            assert!(
                lights.is_sorted_by(|a, b| a < b),
                "{}: {lights:?}",
                map.name
            );
            assert!(lights[20] - lights[0] > 0.5, "{}", map.name);
        }
        let taken = (0..=255).map(|i| map.color(f64::from(i) / 255.0));
        assert!(taken.into_iter().all(|color| color != map.no_value()));
    }
}

#[test]
fn blending_goes_from_the_picture_to_the_heatmap() {
    let (heat, picture) = ([[200, 0, 100]], [[0, 100, 100]]);
    assert_eq!(blend(&heat, &picture, 0.0), picture);
    assert_eq!(blend(&heat, &picture, 1.0), heat);
    assert_eq!(blend(&heat, &picture, 0.25), [[50, 75, 100]]);
}

#[test]
fn a_legend_stands_around_pixels_that_it_does_not_touch() {
    // A small picture, a long line of words, and a picture without values.
    for (values, width) in [
        (vec![1.0f32, 2.0, 3.0, 4.0, 5.0, 6.0], 3),
        (vec![f32::NAN; 6], 3),
    ] {
        let image = HeatImage {
            width,
            height: 2,
            values,
            grain: 1.0,
        };
        let colors = map("viridis");
        let scale = HeatScale::new(&image, Scale::Linear, Range::Automatic, colors);
        let pixels: Vec<_> = (0..6u8).map(|i| [10 * i, 200, 7]).collect();
        let picture = HeatPicture {
            image: &image,
            pixels: pixels.clone(),
            scale,
            colors,
        };
        let short = Captions {
            title: "N_NODES".into(),
            ..Captions::default()
        };
        let long = Captions {
            figures: "many words ".repeat(40),
            ..short.clone()
        };
        let [short, long] = [short, long].map(|captions| with_legend(&picture, &captions));
        assert_eq!(short.width(), long.width());
        assert!(long.height() > short.height() + 50, "lines are broken");
        let found: Vec<_> = short
            .pixels()
            .map(|p| p.0)
            .filter(|p| p[1] == 200 && p[2] == 7)
            .collect();
        assert_eq!(found, pixels);
        // No word touches the edge.
        for (x, y, pixel) in long.enumerate_pixels() {
            let edge = x < 8 || y < 8 || x + 8 >= long.width() || y + 8 >= long.height();
            assert!(!edge || pixel.0 == [255; 3], "{x}, {y}");
        }
        let ink = |image: &image::RgbImage| image.pixels().filter(|p| p.0[0] < 120).count();
        assert!(ink(&short) > 50, "there is a title");
        let bar = short
            .pixels()
            .filter(|p| p.0 == colors.color(0.999))
            .count();
        assert_eq!(
            bar > 0,
            scale.is_some(),
            "there is a bar where there is a scale"
        );
    }
}
