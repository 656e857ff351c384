//! A plugin in Rust: `cargo build -p swanilda-plugin --example rust_plugin` makes `librust_plugin.so`, which is called `libsimRust.so` beside
//! a scene with `loadPlugin 'simRust'`.

use swanilda_plugin::{Call, Value, plugin};

plugin! { version: 1, functions: [func, echo, fail, panic, ask] }

/// An answer to a greeting.
fn func(_: &Call, args: Vec<Value>) -> Result<Vec<Value>, String> {
    match args.as_slice() {
        [Value::Text(greeting)] if greeting == b"Hello" => {
            Ok(vec![Value::Text(b"Hello to you too!".to_vec())])
        }
        _ => Err("say Hello.".to_owned()),
    }
}

fn echo(_: &Call, args: Vec<Value>) -> Result<Vec<Value>, String> {
    Ok(args)
}

fn fail(_: &Call, _: Vec<Value>) -> Result<Vec<Value>, String> {
    Err("no good".to_owned())
}

fn panic(_: &Call, args: Vec<Value>) -> Result<Vec<Value>, String> {
    Ok(vec![args[1000].clone()])
}

/// Calls a function of the script: its name and arguments.
fn ask(call: &Call, mut args: Vec<Value>) -> Result<Vec<Value>, String> {
    if args.is_empty() {
        return Err("the name of a function is needed.".to_owned());
    }
    let Value::Text(name) = args.remove(0) else {
        return Err("the name of a function is needed.".to_owned());
    };
    call.log("simRust", 450, "the plugin asks.")?;
    call.call_script(call.script(), &String::from_utf8_lossy(&name), &args)
}
