//! Native plugins, compiled by the test and loaded by the command from the folder of the scene.
#![cfg(unix)]

use std::fs;
use std::path::Path;
use std::process::Command;

use test_support::process::{output_of, run_bounded, run_for_code};

const ROOT: &str = env!("CARGO_MANIFEST_DIR");

/// Compiles a plugin from `tests/support`.
fn compile(source: &str, library: &Path) {
    let compiler = if source.ends_with(".cpp") {
        "c++"
    } else {
        "cc"
    };
    let mut command = Command::new(compiler);
    command
        .args(["-shared", "-fPIC", "-Wall", "-Wextra", "-Werror", "-I"])
        .arg(format!("{ROOT}/include"));
    command
        .arg("-o")
        .arg(library)
        .arg(format!("{ROOT}/tests/support/{source}"))
        .args(["-ldl", "-lpthread"]);
    let output = command.output().expect("there is a compiler");
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
}

/// A folder with the plugins simT in C and simCpp in C++, and a scene.
fn folder(code: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a temporary folder can be made");
    compile("plugin.c", &folder.path().join("libsimT.so"));
    fs::write(
        folder.path().join("scene.lua"),
        format!("sim = require 'sim'\n{code}"),
    )
    .expect("it is writable");
    folder
}

fn command(folder: &Path, args: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_swanilda"));
    command
        .arg("run")
        .arg(folder.join("scene.lua"))
        .args(["--empty", "--time", "1"])
        .args(args);
    command.env("XDG_CACHE_HOME", folder.join("cache"));
    command
}

fn run(code: &str) -> String {
    let folder = folder(code);
    run_bounded(&mut command(folder.path(), &["--quiet"]))
        .unwrap_or_else(|error| panic!("{error}\nof {code}"))
}

fn assert_prints(code: &str, expected: &[&str]) {
    let output = run(&format!("local simT = loadPlugin('simT')\n{code}"));
    // Its own lines, and warnings about functions that are old for scripts.
    let is_expected =
        |line: &&str| !line.contains("the plugin has") && !line.contains(" is deprecated. ");
    let lines: Vec<&str> = output.lines().filter(is_expected).collect();
    assert_eq!(lines, expected, "of {code}");
}

#[test]
fn values_go_in_and_out() {
    assert_prints(
        "print(simT.func('Hello'), simT['in'].a.table())
        print(simT.echo(1, 'a', {1, 2}))
        print(select('#', simT.echo(nil, 2, nil)))
        print(simT.mixed(1, 2))
        print(math.type(simT.mixed()))
        local t = simT.tables({1, 2.5, 3})
        print(t.sum, #t.bytes, isbuffer(t.bytes), t.list)
        print(simT.rotate('a', 'b', 'c'))
        print(simT.unfold({a = 1}))
        print(simT.unfold({'x', true}))",
        &[
            "Hello to you too!, Hello to you too!",
            "1, a, {1, 2}",
            "3",
            "5, 2.5, x, true",
            "integer",
            "6.5, 3, true, {10, 20, 30}",
            "b, c, a",
            "a, 1",
            "1, x, 2, true",
        ],
    );
}

#[test]
fn what_plugins_learn_of_values() {
    assert_prints(
        "print(simT.tableInfos({1, 2, 3}))
        print(simT.tableInfos({a = 1})[1], simT.tableInfos({})[1], simT.tableInfos(5)[1], simT.tableInfos({'a'})[5])
        print(simT.readInt(2.0))
        print(simT.readInt('x'))
        print(simT.readInt())",
        &["{3, 0, 1, 0, 0, 0}", "-2, 0, -3, 1", "1, 2", "0, -99", "-1, -99"],
    );
}

#[test]
fn variables_and_names() {
    assert_prints(
        "print(simT.E.a, simT.text, loadPlugin('simT') == simT, sim_plugin_namespaces.simT == simT)
        print(sim.isPluginLoaded('simT'), sim.loadPlugin('simT'))
        print(simT.version())",
        &["3, from a stack, true, true", "true, 0", "1, true, 0."],
    );
}

#[test]
fn modules_stand_in_for_plugins_and_wrap_them() {
    let folder = folder(
        "print(loadPlugin('simIK') == require 'simIK', sim.loadPlugin('simConvex'))
        local simT = require 'simT'
        print(simT.func(), require 'simT' == simT, simT.twice('a'))",
    );
    let wrapper = "local simT = loadPlugin 'simT' function simT.twice(x) return simT.echo(x, x) end return simT";
    fs::write(folder.path().join("simT.lua"), wrapper).expect("it is writable");
    let output = run_bounded(&mut command(folder.path(), &["--quiet"])).expect("it ends");
    assert!(
        output.contains("true, 0\n") && output.contains("Hello to you too!, true, a, a\n"),
        "{output}"
    );
}

#[test]
fn errors_of_plugins() {
    assert_prints(
        "print(pcall(simT.fail))
        print(pcall(simT.failInTheOldWay))
        print(pcall(simT.func))",
        &[
            "false, 3: error in 'sim.genericFunctionHandler': no good (c: simSetLastError)",
            "false, 4: error in 'sim.genericFunctionHandler': no good either (c: simSetLastError)",
            "true, Hello to you too!",
        ],
    );
}

#[test]
fn plugins_call_scripts() {
    let output = run("local simT = loadPlugin('simT')
        function f(x) return x * 2, 'k' end
        function g() error('on purpose') end
        t = {inner = function(...) return simT.callScript('f', 4) end}
        print('too early', simT.callScript('f', 2))
        function sysCall_init()
            print(simT.callScript('f', 2))
            print(simT.callScript('t.inner'))
            print(simT.callScript('noSuchFunction', 1, 2))
            print(simT.callScript('g'))
        end");
    assert!(output.contains("too early, -1, 1\n"), "{output}");
    assert!(
        output.contains("4, k, 0, 3\n8, k, 0, 3, 0, 5\n"),
        "{output}"
    );
    let failed = "External call to simCallScriptFunction failed ('noSuchFunction'): failed calling script function.";
    assert!(
        output.contains(failed) && output.contains("\n-1, 1\n"),
        "{output}"
    );
    assert!(
        output.contains("on purpose") && output.contains("failed ('g')"),
        "{output}"
    );
}

#[test]
fn a_script_answers_all_calls_itself_if_it_wants() {
    assert_prints(
        "function f() return 'not called' end
        function sysCall_ext(...) return 'ext', ... end
        function sysCall_init() print(simT.callScript('f', 2)) end",
        &["ext, f, 2, 0, 4"],
    );
}

#[test]
fn functions_of_the_simulator() {
    assert_prints(
        "local dummy = sim.createDummy(0.1)
        print(simT.moveObject(dummy))
        print(sim.getObjectPosition(dummy))",
        &[
            "2, {1., 2., 3.}, dummy, true, -1., 1, -1, 71, 0",
            "{1., 2., 3.}",
        ],
    );
}

#[test]
fn several_results_of_one_function() {
    assert_prints(
        "local shape = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {1, 1, 1})
        local sensor = sim.createVisionSensor(1, {16, 16, 0, 0}, {0.01, 1, 1, 0.1, 0.1, 0.1, 0, 0, 0, 0, 0})
        sim.handleVisionSensor(sensor)
        local _, values = sim.readVisionSensor(sensor)
        local vertices, indices, normals = sim.getShapeMesh(shape)
        local r = {simT.manyResults({shape, sensor})}
        local function same(a, b) return table.concat(a, ' ') == table.concat(b, ' ') end
        print(r[1], same(r[2], vertices), same(r[3], indices), same(r[4], normals))
        print(r[5], r[6])
        print(r[7], r[8], #values == 15 and same(r[9], values))
        print(r[10], r[11], r[12], #r[13], r[13]:gsub('\\0', ','), r[14], r[15], r[16])",
        &["1, true, true, true", "1, {24, 36}", "0, {1, 15}, true", "0.25, true, false, 8, one,two,, 2, 0, -1"],
    );
}

#[test]
fn misuse_fails_and_does_no_harm() {
    assert_prints(
        "print((simT.misuse()))\nprint(simT.func())",
        &["0", "Hello to you too!"],
    );
    let output = run(
        "local simT = loadPlugin('simT') print(simT.fromThread(), simT.fromThread(), simT.func())",
    );
    assert!(output.contains("-1., -1., Hello to you too!"), "{output}");
    let told = "a plugin called simGetSimulationTime_D outside of a call by the simulator";
    assert_eq!(output.matches(told).count(), 1, "{output}");
}

#[test]
fn a_function_that_is_missing_is_named() {
    let output = run("print(loadPlugin('simT').missing())");
    let told = "the plugin calls simModifyPointCloud_D: it is not implemented in Swanilda";
    assert_eq!(output.matches(told).count(), 1, "{output}");
    assert!(
        output.contains("-2, simModifyPointCloud_D: it is not implemented in Swanilda"),
        "{output}"
    );
}

#[test]
fn messages_of_every_phase() {
    assert_prints(
        "function sysCall_afterSimulation()
            local counts, after = simT.messageCounts()
            print(counts[285], counts[340], counts[341], counts[342], counts[343], counts[334], after, counts[269] > 20)
        end
        function sysCall_actuation()
            if sim.getSimulationTime() > 0.47 then sim.stopSimulation() end
        end",
        &["1, 2, 26, 26, 2, 1, 13, false"],
    );
}

#[test]
fn a_plugin_lives_as_long_as_its_users() {
    let output = run("local simT = loadPlugin('simT')
        local text = [[sim = require 'sim' function sysCall_init() loadPlugin('simT') print(loadPlugin('simT').func()) end]]
        local other = sim.createScript(sim.scripttype_customization, text)
        sim.initScript(other)
        sim.removeObjects{other}
        local _, _, destroyed = simT.messageCounts()
        print(destroyed == other, simT.func())
        unloadPlugin(simT)
        print(pcall(simT.func))
        print(loadPlugin('simT').func())");
    let lines: Vec<&str> = output.lines().collect();
    let text = lines.join("\n");
    assert!(
        text.contains("Hello to you too!\ntrue, Hello to you too!"),
        "{text}"
    );
    assert!(
        text.contains("the plugin is not loaded any more."),
        "{text}"
    );
    assert_eq!(text.matches("the plugin has started.").count(), 2, "{text}");
    assert_eq!(text.matches("the plugin has ended.").count(), 2, "{text}");
}

#[test]
fn what_cannot_be_loaded_is_told() {
    let folder = folder(
        "print(loadPlugin('simNowhere'), loadPlugin('simText'), loadPlugin('simEmpty'), loadPlugin('simBad'))
        print(loadPlugin('../simT'), sim.loadPlugin('simBad'))",
    );
    let path = folder.path();
    fs::write(path.join("libsimText.so"), "no library").expect("it is writable");
    fs::copy(path.join("libsimT.so"), path.join("libsimBad.so")).expect("it is writable");
    let empty = path.join("empty.c");
    fs::write(&empty, "int nothing;").expect("it is writable");
    let compiled = Command::new("cc")
        .args(["-shared", "-fPIC", "-o"])
        .arg(path.join("libsimEmpty.so"))
        .arg(&empty)
        .status();
    assert!(compiled.is_ok_and(|status| status.success()));
    let output = run_bounded(&mut command(path, &["--quiet"])).expect("it ends");
    for told in [
        "plugin simNowhere: there is no file libsimNowhere.so in ",
        "libsimText.so: file too short",
        "plugin simEmpty: missing init entry point in plugin",
        "plugin simBad: could not properly initialize plugin (the last error: it is bad)",
        "plugin ../simT: a plugin's name consists of letters",
        "nil, nil, nil\n",
        "nil, -1\n",
    ] {
        assert!(output.contains(told), "{told}\n{output}");
    }
}

#[test]
fn no_unsafe_loads_none() {
    let folder = folder("print(pcall(loadPlugin, 'simT'))");
    let output =
        run_bounded(&mut command(folder.path(), &["--quiet", "--no-unsafe"])).expect("it ends");
    assert!(
        output.contains("loading the plugin 'simT' is not allowed: run with --allow-native"),
        "{output}"
    );
}

#[test]
fn plugins_in_other_folders_and_in_cpp() {
    let folder = folder(
        "local simCpp = loadPlugin('simCpp-2')
        print(simCpp.func('Hello'), simCpp.func('Bye'), sim_plugin_namespaces.simCpp == simCpp)
        print(pcall(simCpp.caught))",
    );
    let plugins = folder.path().join("plugins");
    fs::create_dir(&plugins).expect("it is writable");
    compile("plugin.cpp", &plugins.join("libsimCpp-2.so"));
    let option = format!("--plugin-path={}", plugins.display());
    let output = run_bounded(&mut command(folder.path(), &["--quiet", &option])).expect("it ends");
    assert!(
        output.starts_with("Hello to you too!, What?, true\nfalse, 4: error in"),
        "{output}"
    );
    assert!(output.contains("caught at the edge"), "{output}");
}

/// Rust cannot catch it: the process ends, and does not go on in an unknown state.
#[test]
fn an_exception_that_nobody_catches_ends_the_process() {
    let folder = folder("print(pcall(loadPlugin('simCpp').uncaught)) print('still here')");
    compile("plugin.cpp", &folder.path().join("libsimCpp.so"));
    let ended = run_for_code(
        &mut command(folder.path(), &["--quiet"]),
        test_support::process::LIMIT,
    );
    let text = ended.expect_err("it ends by a signal");
    let told = "swanilda: uncaught of the plugin simCpp let an exception out.";
    assert!(
        text.contains(told) && !text.contains("still here"),
        "{text}"
    );
}

#[test]
fn a_crash_is_told_with_its_place() {
    let folder = folder("loadPlugin('simT').func() loadPlugin('simT').crash()");
    let ended = run_for_code(
        &mut command(folder.path(), &["--quiet", "--isolate"]),
        test_support::process::LIMIT,
    );
    let (code, text) = ended.expect("only the child ends by a signal");
    let told =
        "the process of the scene has crashed in crash of the plugin simT: signal: 6 (SIGABRT)";
    assert!(code == 70 && text.contains(told), "{code}: {text}");
    fs::write(folder.path().join("scene.lua"), "error('on purpose')").expect("it is writable");
    let ended = run_for_code(
        &mut command(folder.path(), &["--quiet", "--isolate"]),
        test_support::process::LIMIT,
    );
    assert_eq!(ended.expect("it ends").0, 1);
}

#[test]
fn what_a_plugin_prints_itself_is_no_line_of_json() {
    let folder = folder("loadPlugin('simT').shout() print('Hello')");
    let output = output_of(&mut command(folder.path(), &["--json"]));
    let (lines, errors) = (
        String::from_utf8_lossy(&output.stdout),
        String::from_utf8_lossy(&output.stderr),
    );
    let is_json = |line: &str| serde_json::from_str::<serde_json::Value>(line).is_ok();
    assert!(
        lines.contains("Hello") && lines.lines().all(is_json),
        "{lines}"
    );
    assert!(errors.contains("written by the plugin itself"), "{errors}");
    let output = run("loadPlugin('simT').shout()");
    assert!(output.contains("written by the plugin itself"), "{output}");
}

/// The example of the documentation.
#[test]
fn the_example_runs() {
    let folder = tempfile::tempdir().expect("a temporary folder can be made");
    compile(
        "../../examples/plugin_hello.c",
        &folder.path().join("libsimHello.so"),
    );
    fs::copy(
        format!("{ROOT}/scenes/plugin_hello.lua"),
        folder.path().join("scene.lua"),
    )
    .expect("it is writable");
    let output = run_bounded(&mut command(folder.path(), &["--quiet"])).expect("it ends");
    assert!(
        output.starts_with("Hello to you too!, from C\nThe ball has fallen to 0.2"),
        "{output}"
    );
}
