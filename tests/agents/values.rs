//! JSON as values of Lua, and back.

use serde_json::{Map, Value, json};
use swanilda::mlua::{self, Lua};

pub fn lua_of(lua: &Lua, value: &Value) -> mlua::Result<mlua::Value> {
    Ok(match value {
        Value::Null => mlua::Value::Nil,
        Value::Bool(value) => mlua::Value::Boolean(*value),
        Value::Number(number) => match number.as_i64() {
            Some(integer) => mlua::Value::Integer(integer),
            None => mlua::Value::Number(number.as_f64().expect("a number")),
        },
        Value::String(text) => mlua::Value::String(lua.create_string(text)?),
        Value::Array(all) => {
            let values = all.iter().map(|value| lua_of(lua, value));
            mlua::Value::Table(lua.create_sequence_from(values.collect::<mlua::Result<Vec<_>>>()?)?)
        }
        Value::Object(fields) => {
            let table = lua.create_table()?;
            for (name, value) in fields {
                table.set(name.as_str(), lua_of(lua, value)?)?;
            }
            mlua::Value::Table(table)
        }
    })
}

/// A table without the key 1 is an object, unless it is empty.
pub fn json_of(value: &mlua::Value) -> Value {
    match value {
        mlua::Value::Boolean(value) => json!(value),
        mlua::Value::Integer(value) => json!(value),
        mlua::Value::Number(value) => json!(value),
        mlua::Value::String(text) => text.to_string_lossy().into(),
        mlua::Value::Table(table) => {
            let all: Vec<mlua::Value> = table.sequence_values().flatten().collect();
            let named = || table.pairs::<String, mlua::Value>().flatten();
            if all.is_empty() && named().next().is_some() {
                let fields = named().map(|(name, value)| (name, json_of(&value)));
                return Value::Object(fields.collect::<Map<_, _>>());
            }
            all.iter().map(json_of).collect()
        }
        _ => Value::Null,
    }
}
