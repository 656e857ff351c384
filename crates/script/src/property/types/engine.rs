//! `engineProperties`: the parameters of a physics engine as one JSON text.
//!
//! Reading returns those of the engine that the scene selects, `{"bullet": {"friction": 0.71, ...}}`. Writing takes those of any engines;
//! omitted parameters are unchanged, unknown names are ignored, and invalid JSON changes nothing.

use serde_json::{Map, Value};

use super::access::{Accessor, Subject, subject_properties};
use crate::error::{ApiError, ApiResult};
use scene::parameters::engine::{EngineOwner, EngineParam, engine_params};
use scene::{Data, ValueType};

macro_rules! engine_properties {
    ($($name:ident $owner:ident;)*) => { $(
        pub(in crate::property) const $name: &[Accessor] = subject_properties! {
            "engineProperties": String, |s| read(s, EngineOwner::$owner)?, |s, json| write(s, EngineOwner::$owner, &json)?;
        };
    )* };
}

engine_properties! {
    SCENE Scene;
    MATERIAL Material;
    JOINT Joint;
    DUMMY Dummy;
}

fn read(subject: &Subject<'_>, owner: EngineOwner) -> ApiResult<String> {
    let scene = subject.sim.scene.borrow();
    let engine = scene.settings().dynamics.engine.engine.name();
    let mut values = Map::new();
    for param in engine_params(owner).filter(|param| param.is_property && param.split().0 == engine)
    {
        let value = scene.engine_value(param, subject.target.object())?;
        values.insert(param.split().1.to_owned(), to_json(&value));
    }
    let all = Value::Object(Map::from_iter([(engine.to_owned(), Value::Object(values))]));
    Ok(format!("{all:#}"))
}

fn write(subject: &Subject<'_>, owner: EngineOwner, json: &str) -> ApiResult<()> {
    let json: Value = serde_json::from_str(json).map_err(|_| ApiError::PropertyNotWritable)?;
    let mut changes: Vec<(&EngineParam, Data)> = Vec::new();
    for param in engine_params(owner).filter(|param| param.is_property) {
        let (engine, name) = param.split();
        let Some(value) = json.get(engine).and_then(|values| values.get(name)) else {
            continue;
        };
        let value =
            from_json(param.ty, value).and_then(|value| param.ty.accept(&param.default, value));
        changes.push((param, value.ok_or(ApiError::PropertyNotWritable)?));
    }
    if !json.is_object() {
        return Err(ApiError::PropertyNotWritable);
    }
    let mut scene = subject.sim.scene.borrow_mut();
    for (param, value) in changes {
        scene.set_engine_value(param, subject.target.object(), value)?;
    }
    Ok(())
}

fn to_json(value: &Data) -> Value {
    match value {
        Data::Bool(on) => (*on).into(),
        Data::Int(number) => (*number).into(),
        Data::Float(number) => (*number).into(),
        Data::Array(items) => items.iter().map(to_json).collect(),
        _ => Value::Null,
    }
}

fn from_json(ty: ValueType, value: &Value) -> Option<Data> {
    match ty {
        ValueType::Bool => value.as_bool().map(Data::Bool),
        ValueType::Int => value.as_i64().map(Data::Int),
        ValueType::Float => value.as_f64().map(Data::Float),
        _ => value
            .as_array()?
            .iter()
            .map(|item| item.as_f64().map(Data::Float))
            .collect::<Option<_>>()
            .map(Data::Array),
    }
}

#[cfg(test)]
mod tests {
    use super::{Data, ValueType, from_json, to_json};

    #[test]
    fn values_come_back_from_json() {
        for (ty, value) in [
            (ValueType::Bool, Data::Bool(true)),
            (ValueType::Int, Data::Int(-1)),
            (ValueType::Float, Data::Float(0.71)),
            (ValueType::FloatArray, vec![0.02, 1.0].into()),
        ] {
            assert_eq!(from_json(ty, &to_json(&value)), Some(value));
        }
        assert_eq!(from_json(ValueType::FloatArray, &"x".into()), None);
    }
}
