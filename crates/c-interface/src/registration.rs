//! What plugins tell of themselves: functions and variables for scripts, descriptions.

use super::dispatch::Call;
use super::functions::{Answer, Function};
use super::plugins::Variable;
use scene::Data;

/// The functions by their names in the table of symbols.
pub(super) const FUNCTIONS: &[(&str, Function)] = &[
    ("register.function", register_function),
    ("register.variable", register_variable),
    ("plugin.set_info", set_info),
    ("plugin.info", info),
    ("plugin.call_method", call_method),
];

fn register_function(call: &Call<'_>) -> Answer {
    let name = call.text(0)?;
    let callback = call
        .values
        .get(2)
        .and_then(|value| value.address.callback())
        .ok_or("NULL is no function")?;
    let is_new = match &call.frame.plugin {
        Some(plugin) => plugin.register(name, callback),
        None => {
            // Programs may name a plugin behind the function, which they are not.
            let function = name.split('@').next().unwrap_or_default().to_owned();
            call.frame.host().register_function(function, callback)?
        }
    };
    Ok(vec![Data::Bool(is_new)])
}

fn register_variable(call: &Call<'_>) -> Answer {
    let stack = call.int(2)?;
    let value = if stack > 0 {
        let items = call.stacks().remove(stack)?;
        Variable::Value(items.into_iter().next_back().unwrap_or(Data::Nil))
    } else {
        Variable::Expression(call.text(1)?)
    };
    call.frame
        .plugin()?
        .variables
        .borrow_mut()
        .push((call.text(0)?, value));
    Ok(vec![Data::Int(1)])
}

fn set_info(call: &Call<'_>) -> Answer {
    let value = if call.int(1)? < 2 {
        call.arg(2)
    } else {
        call.arg(3)
    };
    call.frame
        .plugin()?
        .infos
        .borrow_mut()
        .insert(call.int(1)?, value.clone());
    Ok(Vec::new())
}

fn info(call: &Call<'_>) -> Answer {
    let name = call.text(0)?;
    if name != call.frame.plugin()?.name {
        return Err(format!("there is nothing known of the plugin {name}"));
    }
    match call.frame.plugin()?.infos.borrow().get(&call.int(1)?) {
        Some(Data::Int(value)) => Ok(vec![Data::Nil, Data::Int(*value)]),
        Some(text) => Ok(vec![text.clone()]),
        None => Err("the plugin has set no such information".into()),
    }
}

/// Plugins describe themselves by a method of the application; there are no others.
fn call_method(call: &Call<'_>) -> Answer {
    let name = call.text(1)?;
    if name == "setPluginInfo" {
        Ok(Vec::new())
    } else {
        Err(format!("the method {name} is not implemented in Swanilda"))
    }
}
