//! Tree files and answers of other programs on the command line.

use crate::support::program::Program;
use serde_json::Value;

#[test]
fn a_tree_is_written_and_read_by_every_command() {
    let program = Program::new();
    program.done("tree balls:1 --method bvh-sweep --set width=4 -o tree.bstree");
    let size = "--resolution 32x32";
    let measured = program.json(&format!(
        "measure balls:1 --tree tree.bstree {size} --format json"
    ));
    let built = program.json(&format!(
        "measure balls:1 --method bvh-sweep --set width=4 {size} --format json"
    ));
    assert_eq!(measured["runs"][0]["method"], "tree.bstree");
    assert!(built["runs"][0]["delta"]["N_AT"].is_number(), "{built}");
    assert_eq!(measured["runs"][0]["delta"], built["runs"][0]["delta"]);
    let text = program.done(&format!(
        "compare balls:1 --a method=sah --b tree=tree.bstree {size}"
    ));
    assert!(text.contains("tree.bstree"), "{text}");
    let text = program.done("probe balls:1 --tree tree.bstree --pixel 100,100");
    assert!(text.contains("tree.bstree: the tree of a file"), "{text}");
    let text = program.done("verify balls:1 --tree tree.bstree --rays 200");
    assert!(text.contains("All 1 trees are valid"), "{text}");
    let written = program.run("tree balls:1 --method grid -o -").stdout;
    assert!(written.starts_with(b"{\"format\":\"bstree\",\"version\":1,\"kind\":\"kd\""));
}

#[test]
fn a_tree_that_cannot_be_used_is_refused_with_its_faults() {
    let program = Program::new();
    program.done("tree balls:1 -o tree.bstree");
    let error = program.refused("measure balls:2 --tree tree.bstree");
    assert!(
        error.contains("a tree of 11 objects, but the scene has 92"),
        "{error}"
    );
    let error = program.refused("measure balls:2 --tree missing.bstree");
    assert!(error.contains("missing.bstree: No such file"), "{error}");
    let error = program.refused("tree.bstree");
    assert!(
        error.contains("open it with its scene: bspscope SCENE --tree tree.bstree"),
        "{error}"
    );
    let error = program.refused("measure balls:1 --method nonsense");
    assert!(error.contains("bvh-sweep"), "{error}");
}

/// Replaces the reference to an object by one to another.
fn lose_an_object(file: &std::path::Path) {
    let bytes = std::fs::read(file).unwrap();
    let data = 64 * bytes.iter().position(|&b| b == b'\n').unwrap().div_ceil(64);
    let line = bytes.split(|&b| b == b'\n').next().unwrap();
    let header: Value = serde_json::from_slice(line).unwrap();
    let arrays = header["arrays"].as_array().unwrap();
    let references = arrays.iter().find(|array| array[0] == "ref").unwrap();
    let from = data + references[3].as_u64().unwrap() as usize;
    let mut bytes = bytes;
    bytes.copy_within(from..from + 4, from + 4);
    std::fs::write(file, bytes).unwrap();
}

#[test]
fn verify_shows_lost_objects_and_the_rays_that_miss() {
    let program = Program::new();
    program.done("tree teaching --method bvh-sweep -o tree.bstree");
    lose_an_object(&program.file("tree.bstree"));
    let output = program.run("verify teaching --tree tree.bstree --rays 2000");
    assert_eq!(output.status.code(), Some(1));
    let text = String::from_utf8(output.stdout).unwrap();
    for words in [
        "invalid",
        "is lost: no leaf refers to it",
        "testing every object finds object",
    ] {
        assert!(text.contains(words), "{words}: {text}");
    }
    // The tree can be measured nevertheless; standard error says what is wrong.
    let output = program.run("measure teaching --tree tree.bstree --resolution 16x16");
    assert_eq!(output.status.code(), Some(0));
    let errors = String::from_utf8(output.stderr).unwrap();
    assert!(errors.contains("is lost"), "{errors}");
}

#[test]
fn a_tree_of_another_file_is_reported() {
    let program = Program::new();
    program.done("generate balls:1 -o a.nff");
    program.done("tree a.nff -o tree.bstree");
    program.done("measure a.nff --tree tree.bstree --resolution 8x8");
    let text = program.read("a.nff");
    program.write("b.nff", &(text + "# changed\n"));
    let output = program.run("measure b.nff --tree tree.bstree --resolution 8x8");
    let errors = String::from_utf8(output.stderr).unwrap();
    assert!(
        errors.contains("tree.bstree: made for a file other than b.nff"),
        "{errors}"
    );
}

#[test]
fn check_classes_answers_and_writes_faults_that_can_be_repeated() {
    let program = Program::new();
    let rays = "ox,oy,oz,dx,dy,dz\n".to_owned() + &"0,0,5,0,0,-1\n".repeat(3);
    program.write("rays.csv", &rays);
    let answers = |text: &str| program.write("answers.csv", text);
    let check = "check balls:1 --rays rays.csv --answers answers.csv";
    answers("object,t\n-1,\n-1,\n-1,\n");
    let output = program.run(check);
    assert_eq!(output.status.code(), Some(1));
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.contains("fault          3"), "{text}");
    assert!(text.contains("the program finds nothing"), "{text}");
    assert_eq!(
        program
            .files()
            .iter()
            .filter(|f| f.starts_with("fault"))
            .count(),
        3
    );
    let again = program.run("verify --replay fault.json");
    assert_eq!(again.status.code(), Some(1));
    let text = String::from_utf8(again.stdout).unwrap();
    assert!(text.contains("A fault: the program is wrong."), "{text}");
    assert!(text.contains("another program: the primary ray"), "{text}");
    answers("object,t\n-1,\n");
    assert!(program.refused(check).contains("3 rays, but 1 answers"));
}
