//! What an editor offers while a script is written: functions, constants, modules and callbacks. Made when the first page asks for it.

use std::collections::BTreeMap;
use std::io::Write;
use std::sync::OnceLock;

use flate2::Compression;
use flate2::write::GzEncoder;
use serde_json::{Value, json};

/// Below the address of the page.
pub(super) const NAME: &str = "editor/reference.json";

/// The table as JSON, compressed with gzip.
pub(super) fn compressed() -> &'static [u8] {
    static TABLE: OnceLock<Vec<u8>> = OnceLock::new();
    TABLE.get_or_init(|| {
        let mut gzip = GzEncoder::new(Vec::new(), Compression::default());
        let written = gzip.write_all(table().to_string().as_bytes());
        // Memory takes all.
        written.and_then(|()| gzip.finish()).unwrap_or_default()
    })
}

/// docs/VIEW_PROTOCOL.md has its form.
fn table() -> Value {
    let mut functions = docs::functions();
    functions.extend(docs::module_functions());
    let functions: Vec<Value> = functions
        .iter()
        .map(|function| json!([function.name, function.signature(), function.summary()]))
        .collect();
    let mut constants: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    for (module, name) in docs::constants() {
        constants.entry(module).or_default().push(name);
    }
    let modules: Vec<Value> = docs::module_names()
        .iter()
        .map(|module| json!([module, docs::module_summary(module)]))
        .collect();
    let callbacks: Vec<Value> = docs::callback_summaries()
        .map(|(name, signature, when)| json!([name, signature, when]))
        .collect();
    json!({ "functions": functions, "constants": constants, "modules": modules, "callbacks": callbacks })
}

#[cfg(test)]
mod tests {
    use std::io::Read;

    use super::*;

    #[test]
    fn names_come_with_signatures_and_sentences() {
        let table = table();
        let row = |list: &str, name: &str| {
            let rows = table[list].as_array().expect("a list");
            rows.iter().find(|row| row[0] == name).cloned()
        };
        let function = row("functions", "sim.getObjectPosition").expect("a function of sim");
        assert_eq!(
            function[1],
            "float[3] position = sim.getObjectPosition(int objectHandle, int relativeToObjectHandle = sim.handle_world)"
        );
        assert_eq!(function[2], "Position of an object");
        assert!(row("functions", "simIK.addElement").is_some());
        assert!(row("modules", "simIK").is_some_and(|row| row[1] != ""));
        assert!(row("callbacks", "sysCall_init").is_some());
        let constants = table["constants"]["sim"].as_array().expect("a list");
        assert!(constants.contains(&"handle_world".into()));
    }

    #[test]
    fn it_is_sent_compressed() {
        let mut text = String::new();
        let read = flate2::read::GzDecoder::new(compressed()).read_to_string(&mut text);
        assert!(read.is_ok());
        let sent: Value = serde_json::from_str(&text).expect("it is JSON");
        assert_eq!(sent, table());
    }
}
