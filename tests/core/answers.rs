//! Answers of other programs: right ones, ties, rounding, and planted faults, each of which is found.

use crate::support::random::Random;
use crate::support::scenes;
use crate::support::scenes::{scene, scene_of, tree_with};
use bspscope::geometry::{Ray, Vec3};
use bspscope::measure::answers::{
    AnswerCheck, AnswerClass, check_answers, read_answers, read_rays,
};
use bspscope::measure::judge::{Answer, Answerer, Case, Verdict};
use bspscope::measure::{answer, sample_rays};
use bspscope::primitive::{Precision, Primitive, Triangle};
use bspscope::progress::Progress;
use bspscope::scene::Scene;
use bspscope::trace::{Hit, RayKind, RenderSettings, thread_pool};

fn check(scene: &Scene, rays: &[Ray], answers: &[Answer], precision: Precision) -> AnswerCheck {
    let tree = tree_with(scene, &scenes::settings("bvh-binned"));
    let pool = thread_pool(2).unwrap();
    check_answers(
        scene,
        &tree,
        (rays, answers),
        precision,
        &pool,
        &Progress::new(),
    )
    .unwrap()
}

/// Rays of a picture with the answers of a tree.
fn answered(scene: &Scene, kind: RayKind, precision: Precision) -> (Vec<Ray>, Vec<Answer>) {
    let tree = tree_with(scene, &scenes::settings("sah"));
    let (pool, progress) = (thread_pool(2).unwrap(), Progress::new());
    let render = RenderSettings::default();
    let sample = sample_rays(scene, &tree, &render, 5000, &pool, &progress).unwrap();
    let answers = answer(scene, &tree, precision, &sample, &pool, &progress).unwrap();
    let rays = sample.rays[kind as usize].clone();
    assert!(rays.len() >= 5000);
    let answers = (0..rays.len()).map(|i| answers.of(kind, i)).collect();
    (rays, answers)
}

#[test]
fn our_own_answers_have_no_faults_in_either_precision() {
    for name in ["balls:2", "rings:1", "tetra:3"] {
        let scene = scene(name);
        for precision in Precision::ALL {
            for kind in [RayKind::Primary, RayKind::Shadow] {
                let (rays, answers) = answered(&scene, kind, precision);
                let check = check(&scene, &rays, &answers, precision);
                assert!(
                    check.faults.is_empty(),
                    "{name}: {:?}",
                    check.faults.first()
                );
                assert_eq!(check.counts.iter().sum::<u64>(), rays.len() as u64);
                // In f32, shadow rays that were made in f64 start inside the objects that they start on.
                if (kind, precision) == (RayKind::Shadow, Precision::F32) {
                    continue;
                }
                let right = check.counts[AnswerClass::Right as usize];
                assert!(right * 100 > rays.len() as u64 * 99, "{name}: {check:?}");
            }
        }
    }
}

#[test]
fn every_planted_fault_is_found_and_can_be_repeated() {
    let scene = scene("balls:2");
    let (rays, mut answers) = answered(&scene, RayKind::Primary, Precision::F32);
    let mut random = Random(7);
    let mut planted = Vec::new();
    for i in (0..rays.len()).step_by(100) {
        let Answer::Nearest(hit) = answers[i] else {
            panic!("expected a hit")
        };
        answers[i] = Answer::Nearest(match (hit.is_hit(), random.below(4)) {
            (false, _) => Hit { t: 1.0, object: 3 },
            (true, 0) => Hit::MISS,
            (true, 1) => Hit {
                t: hit.t * 1.01,
                ..hit
            },
            (true, 2) => Hit {
                object: 9999,
                ..hit
            },
            (true, _) => Hit { t: f64::NAN, ..hit },
        });
        planted.push(i);
    }
    let check = check(&scene, &rays, &answers, Precision::F32);
    let found: Vec<usize> = check.faults.iter().map(|fault| fault.number).collect();
    assert_eq!(found, planted);
    for fault in check.faults.iter().step_by(7) {
        let case = Case::of_program(&scene, Precision::F32, fault.ray, fault.found).unwrap();
        let case = case.expect("it is a fault").shrunk();
        let Answer::Nearest(hit) = case.found else {
            panic!("expected a hit")
        };
        // A number that is no object cannot be kept.
        if hit.object != 9999 {
            assert!(
                case.scene.objects().len() <= 2,
                "{}",
                case.scene.objects().len()
            );
        }
        if hit.t.is_finite() || !hit.is_hit() {
            let again = Case::from_json(&case.to_json()).unwrap();
            assert_eq!(again.by, Answerer::Program(Precision::F32));
            let again = again.replay().unwrap().expect("it is still a fault");
            assert!(matches!(
                again.verdict(),
                Verdict::Fault {
                    b_is_wrong: true,
                    ..
                }
            ));
        }
    }
    let (rays, mut answers) = answered(&scene, RayKind::Shadow, Precision::F64);
    let blocked = (0..rays.len()).filter(|&i| answers[i].is_hit());
    let planted: Vec<usize> = blocked.step_by(50).collect();
    assert!(planted.len() > 5);
    for &i in &planted {
        answers[i] = Answer::Blocked(false);
    }
    let found = self::check(&scene, &rays, &answers, Precision::F64).faults;
    assert_eq!(
        found.iter().map(|fault| fault.number).collect::<Vec<_>>(),
        planted
    );
}

#[test]
fn ties_and_rounding_are_no_faults() {
    let across = |z: f64| {
        let corners = [(-1.0, -1.0), (2.0, -1.0), (-1.0, 2.0)];
        let vertices = corners.map(|(x, y)| Vec3::new(x, y, z));
        Primitive::Triangle(Triangle::new(vertices, None).unwrap())
    };
    let scene = scene_of(vec![across(3.0), across(3.0), across(3.0 + 1e-7)]);
    let rays = [Ray::new(Vec3::ZERO, Vec3::Z); 4];
    let hit = |object, t| Answer::Nearest(Hit { t, object });
    let answers = [hit(0, 3.0), hit(1, 3.0), hit(2, 3.0 + 1e-7), hit(2, 3.1)];
    assert_eq!(
        check(&scene, &rays, &answers, Precision::F32).counts,
        [1, 1, 1, 1]
    );
    assert_eq!(
        check(&scene, &rays, &answers, Precision::F64).counts,
        [1, 1, 0, 2]
    );
}

#[test]
fn files_are_read_in_every_form_and_refused_with_a_reason() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str, bytes: &[u8]| {
        let path = folder.path().join(name);
        std::fs::write(&path, bytes).unwrap();
        path
    };
    let text = b"dx, dy,dz,oz,oy,ox,note\n0,0,1,3,2,1,x\n0.5,0,1,-3,2,1e3,\n";
    let rays = read_rays(&file("rays.csv", text)).unwrap();
    let first = Ray::new(Vec3::new(1.0, 2.0, 3.0), Vec3::Z);
    let second = Ray::new(Vec3::new(1e3, 2.0, -3.0), Vec3::new(0.5, 0.0, 1.0));
    assert_eq!(rays, [first, second]);
    let numbers = rays.iter().flat_map(|ray| {
        let ends = [ray.t_min, ray.t_max];
        [
            ray.origin.to_array().as_slice(),
            &ray.direction.to_array(),
            &ends,
        ]
        .concat()
    });
    let wide: Vec<u8> = numbers.clone().flat_map(f64::to_le_bytes).collect();
    let narrow: Vec<u8> = numbers.flat_map(|n| (n as f32).to_le_bytes()).collect();
    assert_eq!(read_rays(&file("rays.f64", &wide)).unwrap(), rays);
    assert_eq!(read_rays(&file("rays.f32", &narrow)).unwrap(), rays);
    let hits = read_answers(&file("hits.csv", b"object,t\n7,0.5\n-1,\n")).unwrap();
    assert_eq!(
        hits,
        [
            Answer::Nearest(Hit { t: 0.5, object: 7 }),
            Answer::Nearest(Hit::MISS)
        ]
    );
    let blocked = read_answers(&file("blocked.csv", b"blocked\n1\n0\n")).unwrap();
    assert_eq!(blocked, [Answer::Blocked(true), Answer::Blocked(false)]);
    for (name, bytes, reason) in [
        (
            "incomplete.f64",
            &wide[..41],
            "the last number is incomplete",
        ),
        ("short.f64", &wide[..40], "expected 8 numbers per row"),
        (
            "title.csv",
            b"ox,oy\n1,2\n",
            "no column 'oz' in the first line",
        ),
        (
            "value.csv",
            b"ox,oy,oz,dx,dy,dz\n1,2,3,4,5,six\n",
            "value.csv:2: expected a number, found 'six'",
        ),
        (
            "rays.txt",
            b"1 2 3",
            "expected the extension .csv, .f32 or .f64",
        ),
    ] {
        let error = read_rays(&file(name, bytes)).unwrap_err().to_string();
        assert!(error.contains(reason), "{error}");
    }
}
