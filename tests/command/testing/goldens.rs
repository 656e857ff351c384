//! Recordings and pictures that tests compare with.

use super::{BOX, has_line, run_in, simulating};

#[test]
fn goldens_are_recorded_compared_and_drawn() {
    let dir = tempfile::tempdir().expect("a folder");
    let suite = |height: &str, tolerances: &str| {
        simulating(&format!(
            "{BOX} it('falls', function()
                local handle = box({height})
                t.golden('fall', {{'/box', z = function() return sim.getObjectPosition(handle)[3] end}}, {tolerances})
                t.run_for(0.3)
            end)"
        ))
    };
    let test = |height: &str, tolerances: &str, args: &[&str]| {
        run_in(
            dir.path(),
            &[("fall_test.lua", &suite(height, tolerances))],
            args,
        )
    };
    let (code, output) = test("1", "{}", &[]);
    assert!(
        code == 1 && output.contains("there is no such file. Record it with --update-golden."),
        "{output}"
    );
    assert_eq!(test("1", "{}", &["--update-golden"]).0, 0);
    let golden = dir.path().join("fall_test.fall.golden");
    let text = std::fs::read_to_string(&golden).expect("it is recorded");
    assert!(
        text.starts_with("# swanilda golden 1\ntime\t/box.x\t"),
        "{text}"
    );
    assert_eq!(test("1", "{}", &[]).0, 0);
    let (code, output) = test("1.1", "{}", &[]);
    assert!(
        code == 1
            && output.contains("first: at 0.000 s /box.z is 1.1")
            && output.contains("worst: "),
        "{output}"
    );
    let png =
        std::fs::read(dir.path().join("test-results/fall_test.fall.123456.png")).expect("a plot");
    assert!(png.starts_with(b"\x89PNG"));
    assert_eq!(test("1.1", "{absolute = 0.11}", &[]).0, 0);
    assert_eq!(
        test("1.1", "{columns = {['/box'] = 0.11, z = 0.11}}", &[]).0,
        0
    );
    assert_eq!(test("1.1", "{columns = {z = 0.11}}", &[]).0, 1);
    assert_eq!(
        std::fs::read_to_string(&golden).expect("it is there"),
        text,
        "a comparison changes nothing"
    );
    std::fs::write(&golden, text.replace("0.1\t", "0.1\tx")).expect("a file");
    let (code, output) = test("1", "{}", &[]);
    assert!(
        code == 1 && output.contains("line 5: 9 numbers are expected."),
        "{output}"
    );
}

#[test]
fn golden_pictures_are_recorded_compared_and_marked() {
    let dir = tempfile::tempdir().expect("a folder");
    let test = |x: &str, options: &str, args: &[&str]| {
        let code = simulating(&format!(
            "it('sees', function()
                local box = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {{0.5, 0.5, 0.5}})
                sim.setObjectPosition(box, {{{x}, 0, 2}})
                local eye = sim.createVisionSensor(1 + 2 + 128, {{32, 16, 0, 0}}, {{0.1, 10, 1, 0.01, 0, 0, 0, 0.5, 1, 0, 0}})
                sim.setObjectAlias(eye, 'Eye')
                t.image('/Eye', {options})
                sim.handleVisionSensor(eye)
                t.image(eye, {{name = 'again'}})
            end)"
        ));
        run_in(dir.path(), &[("eye_test.lua", &code)], args)
    };
    let (code, output) = test("0", "{name = 'box'}", &[]);
    assert!(
        code == 1 && output.contains("golden 'box' (") && output.contains("there is no such file"),
        "{output}"
    );
    assert_eq!(test("0", "{name = 'box'}", &["--update-golden"]).0, 0);
    let recorded = std::fs::read(dir.path().join("eye_test.box.png")).expect("it is recorded");
    assert_eq!(
        std::fs::read(dir.path().join("eye_test.again.png")).expect("it is recorded"),
        recorded
    );
    assert_eq!(test("0", "{name = 'box'}", &[]).0, 0);
    let (code, output) = test("0.1", "{name = 'box'}", &["--html", "report.html"]);
    assert!(
        code == 1 && output.contains("of 512 pixels are off by more than 2 of 255"),
        "{output}"
    );
    let marked =
        std::fs::read(dir.path().join("test-results/eye_test.box.123456.png")).expect("a picture");
    assert!(marked.starts_with(b"\x89PNG"));
    let report = std::fs::read_to_string(dir.path().join("report.html")).expect("a report");
    assert!(
        report.contains("src=\"data:image/png;base64,"),
        "the report shows the difference"
    );
    let (_, output) = test("0.1", "{name = 'box', tolerance = 255}", &[]);
    assert!(
        !output.contains("golden 'box'") && output.contains("golden 'again'"),
        "{output}"
    );
    let (_, output) = test("0.1", "{name = 'box', share = 0.5}", &[]);
    assert!(!output.contains("golden 'box'"), "{output}");
    for (options, reason) in [
        ("{size = 3}", "wrong option size"),
        ("{name = '../x'}", "a name is made of letters"),
    ] {
        let (code, output) = test("0", options, &[]);
        assert!(code == 1 && output.contains(reason), "{output}");
    }
}

#[test]
fn two_tests_with_one_golden_are_one_failure() {
    let code = format!(
        "{BOX} for i = 1, 3 do it('t' .. i, function() box(1) t.golden('same', {{'/box'}}) t.step(2) end) end"
    );
    let dir = tempfile::tempdir().expect("a folder");
    let (code, output) = run_in(
        dir.path(),
        &[("a_test.lua", &simulating(&code))],
        &["--update-golden", "-v"],
    );
    assert_eq!(code, 1);
    assert!(has_line(&output, "PASS a_test.lua::t1"), "{output}");
    assert_eq!(
        output
            .matches("\n    golden 'same' is the name of another test's recording")
            .count(),
        2,
        "{output}"
    );
}
