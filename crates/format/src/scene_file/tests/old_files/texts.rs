//! Scripts of old files: which run, whose they are, and how their texts change; image filters.

use super::super::super::{LoadedScript, SceneFile, ScriptCode};
use super::{file, loaded, object};
use crate::ttt::chunks::{Filter, FilterChain, Script as Chunk, ScriptObject, VisionSensor};
use crate::ttt::tree::{Class, Contents};
use crate::ttt::{Counted, File, ScriptText};
use scene::object::script_object::ScriptType;

fn script(kind: i32, owner: i32, switches: u8, text: &str) -> Chunk {
    Chunk {
        ids: Some([0, owner, kind]),
        switches: Some(switches),
        switches_2: Some(1),
        text: Some(ScriptText(text.into())),
        ..Chunk::default()
    }
}

fn with(version: u16, scripts: Vec<Chunk>) -> File {
    let objects = vec![
        object(1, -1, Class::Dummy(Box::default())),
        object(2, 1, Class::Dummy(Box::default())),
    ];
    let contents = Contents {
        objects,
        scripts,
        ..Contents::default()
    };
    file(version, 22, contents)
}

fn attached(version: u16, script: Chunk) -> Option<LoadedScript> {
    loaded(with(version, vec![script])).1.scripts.pop()
}

/// The text of a simulation script of that version.
fn text(version: u16, switches: u8, text: &str) -> String {
    let script = attached(version, script(1, 1, switches, text)).unwrap();
    String::from_utf8(script.code).unwrap()
}

#[test]
fn main_scripts_count_where_a_switch_says_so() {
    let main = |version, switches| attached(version, script(0, -1, switches, "x = 1")).is_some();
    assert!(main(40_000, 0x8) && !main(40_000, 0xf7));
    // Before 3.1.3 it was called in another way.
    assert!(main(30_103, 0xc8) && !main(30_103, 0x48) && !main(30_103, 0x88) && main(30_104, 0x8));
}

#[test]
fn callbacks_and_scripts_of_nobody_are_left_out() {
    for kind in [3, 4, 5, 7] {
        assert_eq!(attached(40_000, script(kind, 1, 0xc8, "")), None);
    }
    assert_eq!(attached(40_000, script(1, 9, 0xc8, "")), None);
    let owner = |custom, coi| {
        let (scene, made) = loaded(with(
            30_500,
            vec![Chunk {
                cust_obj_handle: custom,
                coi,
                ..script(6, -1, 0xc8, "")
            }],
        ));
        let owner = made.scripts.first().and_then(|script| script.owner);
        assert_eq!(scene.len(), 2);
        owner.and_then(|owner| made.objects.iter().position(|object| *object == owner))
    };
    assert_eq!(
        [
            owner(Some(2), Some(1)),
            owner(None, Some(1)),
            owner(None, None)
        ],
        [Some(1), Some(0), None]
    );
    let first = attached(
        40_000,
        Chunk {
            cust_obj_handle: Some(2),
            ..script(6, 1, 0xca, "")
        },
    )
    .unwrap();
    assert!(first.disabled && first.script_type == ScriptType::Customization);
    assert!(!attached(40_000, script(1, 1, 0xc8, "")).unwrap().disabled);
}

#[test]
fn objects_that_are_scripts() {
    let read = |switches, second, first| {
        let script = Chunk {
            switches_2: Some(second),
            ..script(1, 1, switches, "x = 1")
        };
        let chunk = ScriptObject {
            script: Some(script),
            switches: Some(first),
            ..ScriptObject::default()
        };
        let object = super::one(Class::ScriptObject(Box::new(chunk)));
        let scene::Kind::Script(script) = object.kind else {
            panic!("no script")
        };
        [
            script.disabled,
            script.parent_is_proxy,
            script.reset_after_sim_error,
        ]
    };
    assert_eq!(
        [read(0, 0, 0), read(2, 0xfb, 0xfe)],
        [[false; 3], [true, false, false]]
    );
    assert_eq!(read(0xfd, 4, 1), [false, true, true]);
    let empty = super::one(Class::ScriptObject(Box::default()));
    let scene::Kind::Script(script) = empty.kind else {
        panic!("no script")
    };
    assert_eq!(script.script_type, ScriptType::Passive);
}

#[test]
fn scripts_are_named_by_the_path_of_their_object() {
    let mut file = with(
        40_000,
        vec![
            script(0, -1, 0xc0, "default"),
            script(0, -1, 0xc8, "main"),
            script(1, 2, 0xc8, "child"),
            script(6, 1, 0xc8, "custom"),
            script(4, 1, 0xc8, "callback"),
        ],
    );
    let chunk = ScriptObject {
        script: Some(script(1, 3, 0, "object")),
        ..ScriptObject::default()
    };
    file.contents
        .objects
        .push(object(3, 2, Class::ScriptObject(Box::new(chunk))));
    let scripts = SceneFile::new(file).unwrap().scripts();
    let found = scripts.iter().map(
        |ScriptCode {
             name,
             code,
             language,
         }| {
            assert_eq!(language, "lua");
            (name.as_str(), std::str::from_utf8(code).unwrap())
        },
    );
    let expected = [
        ("mainScript", "main"),
        ("/o1/o2@simulationScript", "child"),
        ("/o1@customizationScript", "custom"),
        ("/o1/o2/o3", "object"),
    ];
    assert_eq!(found.collect::<Vec<_>>(), expected);
}

#[test]
fn a_circle_of_parents_has_a_path_with_an_end() {
    let mut file = with(40_000, vec![script(1, 2, 0xc8, "x")]);
    file.contents.objects[0].common.handles = Some([1, 2]);
    let scripts = SceneFile::new(file).unwrap().scripts();
    assert_eq!(scripts[0].name.matches('/').count(), 100);
}

#[test]
fn languages() {
    let language = |lang: Option<&str>, text: &str| {
        let chunk = Chunk {
            lang: lang.map(Into::into),
            ..script(1, 1, 0xc8, text)
        };
        let script = attached(41_000, chunk).unwrap();
        (script.language, String::from_utf8(script.code).unwrap())
    };
    let is = |language: &str, text: &str| (language.to_owned(), text.to_owned());
    assert_eq!(language(None, "#python\nsim.x\n"), is("python", "sim.x\n"));
    assert_eq!(language(None, "simWait(1)"), is("lua", "sim.wait(1)"));
    assert_eq!(language(Some(""), "#python\nx"), is("python", "x"));
    // Only Lua is brought up to date.
    assert_eq!(
        language(Some("python"), "simWait(1)"),
        is("python", "simWait(1)")
    );
}

#[test]
fn texts_change_with_the_version_that_wrote_them() {
    let since = |first: u16, old: &str, new: &str| {
        assert_eq!(text(first - 1, 0xc8, old), new, "before {first}");
        assert_eq!(text(first, 0xc8, old), old, "since {first}");
    };
    since(
        40_800,
        "sim.callScriptFunction('f@o')",
        "sim._callScriptFunction('f@o')",
    );
    since(40_200, "goto = 1", "goto_ = 1");
    since(30_300, "x\t= 1", "x    = 1");
    since(30_401, "'<ui onclose=\"f\">'", "'<ui on-close=\"f\">'");
    let own = "sim.getObjectAssociatedWithScript(sim.handle_self)";
    since(40_200, own, "sim.getObjectHandle(sim.handle_self)");
    let end = "sim.getSimulationState()~=sim.simulation_advancing_abouttostop";
    since(40_200, end, "true");
    let relative = "sim.getObjectPosition(a,b)";
    assert!(text(40_000, 0xc8, relative).ends_with("\n__getObjectPosition__(a,b)"));
    assert_eq!(text(40_001, 0xc8, relative), relative);
}

#[test]
fn colours_had_another_meaning_where_a_chunk_is_missing() {
    let colour = "sim.setShapeColor(h,nil,0,c)";
    let with = |version, switches_2| {
        let chunk = Chunk {
            switches_2,
            ..script(1, 1, 0xc8, colour)
        };
        String::from_utf8(attached(version, chunk).unwrap().code).unwrap()
    };
    assert!(with(39_999, None).contains("colorCorrectionFunction(h)"));
    assert_eq!([with(39_999, Some(0)), with(40_000, None)], [colour; 2]);
}

#[test]
fn threads_become_coroutines() {
    let main = "function sysCall_threadmain() end";
    assert!(text(40_199, 0xc9, main).contains("coroutine.create(coroutineMain)"));
    assert!(text(40_199, 0xc9, main).contains("else\n        corout=coroutine.create"));
    assert!(!text(40_199, 0xd9, main).contains("else\n        corout=coroutine.create"));
    assert_eq!(
        [text(40_200, 0xc9, main), text(40_199, 0xc8, main)],
        [main; 2]
    );
    assert_eq!(text(40_199, 0xc9, " \n "), " \n ");
    assert!(text(40_199, 0xc9, "x = 1").ends_with("function coroutineMain() x = 1\nend\n"));
}

#[test]
fn texts_from_before_there_were_calls_run_once_a_step() {
    assert_eq!(
        text(30_103, 0x0, "x = 1"),
        "function sysCall_actuation() x = 1\nend\n"
    );
    assert_eq!(
        text(30_103, 0x20, "x = 1"),
        "function sysCall_sensing() x = 1\nend\n"
    );
    assert_eq!(
        [text(30_103, 0xc0, "x = 1"), text(30_104, 0x0, "x = 1")],
        ["x = 1"; 2]
    );
    assert_eq!(text(30_103, 0x0, " \n"), " \n");
}

#[test]
fn texts_without_old_code_keep_their_bytes() {
    let bytes = b"-- caf\xe9\nx = 1".to_vec();
    let chunk = Chunk {
        text: Some(ScriptText(bytes.clone())),
        ..script(1, 1, 0xc8, "")
    };
    assert_eq!(attached(30_500, chunk).unwrap().code, bytes);
    let old = b"-- caf\xe9\nsimWait(1)".to_vec();
    let chunk = Chunk {
        text: Some(ScriptText(old)),
        ..script(1, 1, 0xc8, "")
    };
    assert_eq!(
        attached(30_500, chunk).unwrap().code,
        b"-- caf\xe9\nsim.wait(1)"
    );
    let unknown = super::super::super::with_compat(b"simWait(1)\ngoto = 1".to_vec());
    assert_eq!(unknown, b"sim.wait(1)\ngoto_ = 1");
}

fn filter(kind: i32, enabled: Option<u8>, bits: u8) -> Filter {
    Filter {
        kind: Some([kind, 0, 0]),
        enabled,
        bytes: Some(Counted(vec![bits])),
        ints: Some(Counted(vec![1, 2])),
        floats: Some(Counted((1..=10_u8).map(f32::from).collect())),
        ..Filter::default()
    }
}

/// The lines of the script that replaces these filters, without its frame.
fn filtered(filters: Vec<Filter>) -> Option<Vec<String>> {
    let sensor = VisionSensor {
        filter: Some(FilterChain { filters }),
        ..VisionSensor::default()
    };
    let contents = Contents {
        objects: vec![object(1, -1, Class::VisionSensor(Box::new(sensor)))],
        ..Contents::default()
    };
    let (_, mut made) = loaded(file(30_500, 21, contents));
    let script = made.scripts.pop()?;
    assert_eq!(
        (script.owner, script.script_type),
        (Some(made.objects[0]), ScriptType::Customization)
    );
    assert!(!script.disabled && script.language == "lua");
    let code = String::from_utf8(script.code).unwrap();
    let body = code.split_once("packet\n    end\n").unwrap().1;
    let body = body.strip_suffix("    return found\nend\n").unwrap();
    Some(body.lines().map(|line| line.trim().to_owned()).collect())
}

#[test]
fn image_filters_become_a_script_where_they_change_something() {
    assert_eq!(
        filtered(vec![filter(1, None, 0), filter(4, Some(1), 0)]),
        None
    );
    assert_eq!(
        filtered(vec![filter(13, Some(0), 0), filter(4, None, 0)]),
        None
    );
    let lines = filtered(vec![
        filter(1, None, 0),
        filter(13, None, 0),
        filter(4, None, 0),
        filter(99, None, 0),
    ]);
    let expected = [
        "simVision.sensorImgToWorkImg(sensor)",
        "simVision.horizontalFlipWorkImg(sensor)",
        "simVision.workImgToSensorImg(sensor, false)",
        "error('the image filter 99 of V-REP 3 is not implemented in Swanilda')",
    ];
    assert_eq!(lines.unwrap(), expected);
}

#[test]
fn image_filters_with_numbers() {
    for (kind, bits, expected) in [
        (3, 0, "uniformImgToWorkImg(sensor, {1, 2, 3})"),
        (15, 0, "rotateWorkImg(sensor, 1)"),
        (16, 1, "shiftWorkImg(sensor, {1, 2}, true)"),
        (17, 0, "resizeWorkImg(sensor, {1, 2})"),
        (21, 0, "edgeDetectionOnWorkImg(sensor, 1)"),
        (22, 0xfe, "rectangularCutWorkImg(sensor, {1, 2}, false)"),
        (23, 1, "circularCutWorkImg(sensor, 1, true)"),
        (25, 0, "intensityScaleOnWorkImg(sensor, 1, 2, true)"),
        (
            26,
            1,
            "selectiveColorOnWorkImg(sensor, {1, 2, 3}, {4, 5, 6}, false, true, false)",
        ),
        (
            26,
            2,
            "selectiveColorOnWorkImg(sensor, {1, 2, 3}, {4, 5, 6}, true, false, false)",
        ),
        (
            26,
            4,
            "selectiveColorOnWorkImg(sensor, {1, 2, 3}, {4, 5, 6}, false, false, true)",
        ),
        (
            27,
            1,
            "scaleAndOffsetWorkImg(sensor, {1, 2, 3}, {4, 5, 6}, {7, 8, 9}, true)",
        ),
        (33, 0, "colorSegmentationOnWorkImg(sensor, 1)"),
    ] {
        let found = filtered(vec![filter(kind, None, bits)]).unwrap();
        assert_eq!(found, [format!("simVision.{expected}")]);
    }
    for (kind, expected) in [
        (
            28,
            "binaryWorkImg(sensor, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, true)",
        ),
        (34, "blobDetectionOnWorkImg(sensor, 1, 2, true)"),
        (35, "coordinatesFromWorkImg(sensor, {1, 2}, true)"),
        (36, "changedPixelsOnWorkImg(sensor, 1)"),
    ] {
        let found = filtered(vec![filter(kind, None, 1)]).unwrap();
        assert_eq!(found, [format!("note(simVision.{expected})")]);
    }
}
