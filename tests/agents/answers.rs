//! What tools answer: errors with the next step, code that is checked, files.

use serde_json::json;

use crate::client::Client;

/// What was wrong, where, and the next step.
#[test]
fn errors_say_what_to_do_next() {
    let mut client = Client::start(&["scenes/inverted_pendulum.lua".into()]);
    for (tool, arguments, said) in [
        (
            "step",
            json!({"cuont": 3}),
            "there is no argument cuont; did you mean count?",
        ),
        ("run_code", json!({}), "the argument code is missing"),
        (
            "run_code",
            json!({"code": "local x = 1\nsim.getObjectPositio(x)"}),
            ">    2 | sim.getObjectPositio(x)",
        ),
        (
            "run_code",
            json!({"code": "local x = 1\nsim.getObjectPositio(x)"}),
            "did you mean getObjectPosition?",
        ),
        (
            "run_code",
            json!({"code": "\nlocal h = sim.getObject('/Nothing')\nreturn h"}),
            ">    2 | local h = sim.getObject('/Nothing')",
        ),
        ("run_code", json!({"code": "for"}), "line 1: "),
        (
            "get_properties",
            json!({"items": ["/Card.mass"]}),
            "Did you mean /Rail/Slider/Cart?",
        ),
        (
            "get_properties",
            json!({"items": ["/Cart.masss"]}),
            "Did you mean mass?",
        ),
        ("get_properties", json!({"items": ["/Cart"]}), "PATH.NAME"),
        (
            "set_properties",
            json!({"values": {"/Cart.mass": 2, "/Cart.masss": 2}}),
            "nothing was set",
        ),
        ("read_script", json!({"script": "/Cart"}), "is no script"),
        (
            "write_script",
            json!({"script": "/Controller", "old": "xyz", "new": ""}),
            "does not occur",
        ),
        (
            "write_script",
            json!({"script": "/Controller", "code": "function"}),
            "The script was not changed.",
        ),
        (
            "run_until",
            json!({"until": {"colision": ["/a", "/b"]}}),
            "did you mean collision?",
        ),
        (
            "run_until",
            json!({"until": {"collision": ["/Pole", "/Card"]}}),
            "Did you mean /Rail/Slider/Cart?",
        ),
        (
            "run_until",
            json!({"watch": ["/Cart.masss"]}),
            "Did you mean mass?",
        ),
        (
            "picture",
            json!({"camera": "/Cart"}),
            "is neither a camera nor a vision sensor",
        ),
        ("restore", json!({"name": "x"}), "`snapshot` makes one"),
        (
            "load",
            json!({"path": "/etc/hostname"}),
            "--allow-read=/etc",
        ),
        ("save", json!({"path": "/etc/x.ttt"}), "--allow-write=/etc"),
        ("run_tests", json!({"path": "/etc"}), "--allow-read"),
        (
            "api",
            json!({"name": "sim.getObjectPositio"}),
            "did you mean sim.getObjectPosition?",
        ),
        (
            "simulation",
            json!({"action": "halt"}),
            "one of \"start\", \"pause\", \"stop\" is needed",
        ),
    ] {
        let answer = client.call(tool, &arguments);
        let text = answer["text"].as_str().expect("text");
        assert!(
            answer["isError"] == true && text.contains(said),
            "{tool} {arguments}: {text}"
        );
    }
    let mass = client.call("get_properties", &json!({"items": ["/Cart.mass"]}));
    assert_eq!(mass["text"], "/Cart.mass = 1 kg\n");
}

#[test]
fn code_is_checked_before_it_runs() {
    let mut client = Client::start(&["scenes/inverted_pendulum.lua".into()]);
    for (arguments, said) in [
        (json!({}), "All 2 scripts are fine"),
        (json!({"path": "scenes/inverted_pendulum.lua"}), "fine"),
        (json!({"script": "/Controller"}), "fine"),
        (json!({"code": "x = = 1"}), "unexpected symbol"),
        (
            json!({"code": "sim.getObjectPositio(1)"}),
            "line 1: sim.getObjectPositio does not exist (did you mean getObjectPosition?)",
        ),
        (
            json!({"code": "simGetObjectPosition(1, -1)"}),
            "is an old name of sim.getObjectPosition",
        ),
        (
            json!({"code": "function sysCall_actution() end"}),
            "did you mean sysCall_actuation?",
        ),
    ] {
        let answer = client.call("check_code", &arguments);
        let text = answer["text"].as_str().expect("text");
        assert!(
            answer["isError"] == false && text.contains(said),
            "{arguments}: {text}"
        );
    }
}

#[test]
fn scenes_models_and_robots_come_from_files_and_go_into_them() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    let urdf = std::fs::read("scenes/gripper.urdf").expect("the robot is there");
    std::fs::write(at("gripper.urdf"), urdf).expect("the folder is ours");
    let mujoco = "<mujoco><worldbody><body name='box'><freejoint/><geom type='box' size='.1 .1 .1'/></body></worldbody></mujoco>";
    std::fs::write(at("box.xml"), mujoco).expect("the folder is ours");
    let sdf = "<sdf version='1.9'><model name='ball'><link name='core'><collision name='c'><geometry><sphere><radius>0.1</radius></sphere></geometry></collision></link></model></sdf>";
    std::fs::write(at("ball.sdf"), sdf).expect("the folder is ours");
    let allowed = format!("--allow-write={}", at(""));
    let readable = format!("--allow-read={}", at(""));
    let mut client = Client::start(&[allowed, readable]);
    let mut done = |tool: &str, arguments: serde_json::Value| {
        let answer = client.call(tool, &arguments);
        assert_eq!(answer["isError"], false, "{tool} {arguments}: {answer}");
        answer["text"].as_str().expect("text").to_owned()
    };
    done("load", json!({"path": at("gripper.urdf")}));
    assert!(done("find_objects", json!({"type": "joint"})).contains("grip_right"));
    done("load", json!({"path": at("box.xml"), "add": true}));
    done("load", json!({"path": at("ball.sdf"), "add": true}));
    let tree = done("scene", json!({}));
    assert!(
        tree.contains("grip_right") && tree.contains("box") && tree.contains("core"),
        "{tree}"
    );
    done("save", json!({"path": at("all.ttt")}));
    done("load", json!({}));
    assert!(done("scene", json!({})).contains("Floor #"));
    done("load", json!({"path": at("all.ttt")}));
    let again = done("scene", json!({}));
    assert_eq!(tree.lines().count(), again.lines().count(), "{tree}{again}");
    let refused = client.call("load", &json!({"path": at("all.ttt"), "add": true}));
    assert!(
        refused["text"]
            .as_str()
            .expect("text")
            .contains("cannot be added"),
        "{refused}"
    );
}

/// Clients and their users know tools by their descriptions.
#[test]
fn tools_and_their_arguments_are_described() {
    let mut client = Client::start(&[]);
    let page = std::fs::read_to_string("docs/AGENTS.md").expect("the page is there");
    let list = client.request("tools/list", &json!({}));
    let tools = list["result"]["tools"].as_array().expect("tools");
    assert!(tools.len() > 20);
    for tool in tools {
        let name = tool["name"].as_str().expect("a name");
        assert!(
            page.contains(&format!("`{name}`")),
            "docs/AGENTS.md: {name}"
        );
        assert!(
            tool["description"]
                .as_str()
                .is_some_and(|text| text.ends_with('.')),
            "{name}"
        );
        assert_eq!(tool["inputSchema"]["type"], "object", "{name}");
        let arguments = tool["inputSchema"]["properties"]
            .as_object()
            .expect("arguments");
        for (argument, schema) in arguments {
            assert!(
                schema["description"]
                    .as_str()
                    .is_some_and(|text| !text.is_empty()),
                "{name} {argument}"
            );
            assert!(
                schema["type"].is_string() || schema["type"].is_array(),
                "{name} {argument}"
            );
        }
        for required in tool["inputSchema"]["required"].as_array().expect("a list") {
            assert!(
                arguments.contains_key(required.as_str().expect("a name")),
                "{name}"
            );
        }
    }
}

/// Objects that share an alias are told apart by an index and by their handles.
#[test]
fn objects_are_named_by_paths_and_by_handles() {
    let mut client = Client::start(&["--empty".into()]);
    let code = "for i = 1, 2 do local d = sim.createDummy(0.1) sim.setObjectAlias(d, 'Twin') sim.setObjectPosition(d, {i, 0, 0}) end";
    client.call("run_code", &json!({"code": code}));
    let tree = client.call("scene", &json!({}));
    let tree = tree["text"].as_str().expect("text");
    assert!(
        tree.contains("Twin[0] #") && tree.contains("Twin[1] #"),
        "{tree}"
    );
    let found = client.call("find_objects", &json!({"pattern": "twin"}));
    for (at, twin) in found["values"]["objects"]
        .as_array()
        .expect("objects")
        .iter()
        .enumerate()
    {
        let by_path = format!("{}.position[1]", twin["path"].as_str().expect("a path"));
        let by_handle = format!("#{}.position[1]", twin["handle"]);
        let values = client.call("get_properties", &json!({"items": [by_path, by_handle]}));
        let values = &values["values"]["values"];
        assert_eq!(values[&by_path], values[&by_handle]);
        assert_eq!(values[&by_path], (at + 1) as f64);
    }
    let watched = client.call("step", &json!({"watch": [format!("#{}.position[1]", 999)]}));
    assert!(
        watched["text"]
            .as_str()
            .expect("text")
            .contains("no object with handle 999"),
        "{watched}"
    );
    assert!(
        client.call("scene", &json!({}))["text"]
            .as_str()
            .expect("text")
            .starts_with("Simulation stopped")
    );
}

#[test]
fn what_is_made_when_the_simulation_starts_can_be_watched() {
    let mut client = Client::start(&[]);
    let code = "sim = require 'sim' function sysCall_init() sim.setObjectAlias(sim.createDummy(0.1), 'Late') end";
    client.call("write_script", &json!({"code": code}));
    let arguments = json!({"watch": ["/Late.position[1]"], "until": {"distance": {"objects": ["/Late", "/Floor"], "above": -1}}, "time": 1});
    let answer = client.call("run_until", &arguments);
    assert_eq!(answer["isError"], false, "{answer}");
    assert_eq!(answer["values"]["reached"], true, "{answer}");
}

/// Scripts in Python are not read as Lua. Without permission to start programs they do not run.
#[test]
fn scripts_in_python_are_kept_as_they_are() {
    let mut client = Client::start(&[]);
    let code = "#python\ndef sysCall_init():\n    sim = require('sim')\n";
    let added = client.call("write_script", &json!({"code": code, "alias": "Snake"}));
    assert_eq!(added["text"], "/Snake was added.", "{added}");
    let text = client.call("read_script", &json!({"script": "/Snake"}));
    assert!(
        text["text"]
            .as_str()
            .expect("text")
            .contains("def sysCall_init():"),
        "{text}"
    );
    let edit = json!({"script": "/Snake", "old": "    sim = require('sim')", "new": "    pass"});
    let changed = client.call("write_script", &edit);
    assert_eq!(changed["text"], "/Snake was changed.", "{changed}");
}
