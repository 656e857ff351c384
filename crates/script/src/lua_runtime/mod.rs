//! Scripts in Lua: the implementation of [`Language`] and [`Interpreter`] above the virtual machine of `script::lua`.

mod bottom;
mod buffers;
pub(crate) mod coverage;
mod debugging;
mod functions;
mod idle;
mod implicit;
mod library_globals;
mod members;
mod old_calls;
pub(crate) mod reference_modules;
mod reused;
mod shared_process;
mod stand_ins;
mod startup;
pub(crate) mod syntax;
mod taped;
mod test_file;
pub(crate) mod threads;
pub(crate) mod user_modules;
mod usual_main;

use std::rc::Rc;

use super::binding::data;
use super::coverage::LineCounts;
use super::lua::{
    LuaError, MULTIPLE, Owner, RunningCallback, Stack, State, Type, running_callback_number,
};
use crate::function_ref::FunctionRef;
use crate::host::{
    CallError, CallbackResult, Callee, Debuggee, Env, Hook, Integers, Interpreter, Language,
    Runtime, ScriptError, Sim, SourceText,
};
use crate::sys_call::SysCall;
use bottom::Bottom;
use coverage::Coverage;
use idle::IdleFunctions;
use permissions::Permissions;
use scene::Data;
use user_modules::UserModule;
use usual_main::UsualMain;

/// The callback that runs now, innermost; None for other calls. For other threads too.
pub fn running_callback() -> Option<SysCall> {
    let number = running_callback_number()?;
    SysCall::ALL
        .iter()
        .copied()
        .find(|call| *call as usize == number)
}

/// Calls a function of a module, both by name, with all that follows.
const CALL: &[u8] = b"local module, member = ... return require(module)[member](select(3, ...))";

/// Errors of Lua for code that yields where it cannot.
const YIELD_ERRORS: [&str; 2] = [
    "attempt to yield across a C-call boundary",
    "attempt to yield from outside a coroutine",
];

/// The language Lua.
#[derive(Clone)]
pub struct LuaLanguage {
    user_modules: Rc<[UserModule]>,
}

impl LuaLanguage {
    /// With modules that the embedding program has written.
    pub fn new(user_modules: Vec<UserModule>) -> Self {
        Self {
            user_modules: user_modules.into(),
        }
    }

    /// An interpreter that is a part of another one.
    pub(crate) fn interpreter(&self, env: &Rc<Env>) -> LuaInterpreter {
        let (state, user_modules) = (State::new(owner(env)), Rc::clone(&self.user_modules));
        LuaInterpreter {
            state,
            bottom: Bottom::default(),
            idle: IdleFunctions::default(),
            user_modules,
        }
    }
}

/// The owner of the state of a script.
fn owner(env: &Rc<Env>) -> Owner {
    let sim = env.sim.upgrade();
    let budget = sim.as_ref().map(|sim| Rc::clone(&sim.scripts.budget));
    let permissions = sim.map(|sim| sim.options.permissions.clone());
    Owner::new(
        Rc::clone(env),
        budget.unwrap_or_default(),
        permissions.unwrap_or_else(Permissions::none),
        env.is_interruptible(),
    )
}

impl<'a> Stack<'a> {
    /// The environment of the script that the state belongs to.
    pub(crate) fn env(self) -> &'a Env {
        self.host()
    }
}

impl Language for LuaLanguage {
    fn name(&self) -> &'static str {
        "lua"
    }

    fn create(&self, env: Rc<Env>) -> Rc<Runtime> {
        match UsualMain::new(self, &env) {
            Some(main) => Runtime::new(env, main),
            None => {
                let interpreter = self.interpreter(&env);
                Runtime::new(env, interpreter)
            }
        }
    }
}

/// A Lua state of its own for one script.
pub(crate) struct LuaInterpreter {
    state: State,
    bottom: Bottom,
    idle: IdleFunctions,
    user_modules: Rc<[UserModule]>,
}

impl LuaInterpreter {
    fn stack(&self) -> Stack<'_> {
        self.state.stack()
    }

    /// Sets a global to what `push` pushes.
    pub(crate) fn set_global(&self, name: &str, push: impl FnOnce(Stack<'_>)) {
        let stack = self.stack();
        push(stack);
        stack.set_global(name);
    }

    fn sim(&self) -> Result<Rc<Sim>, ScriptError> {
        self.stack()
            .env()
            .sim
            .upgrade()
            .ok_or_else(|| ScriptError::new("the simulator is gone."))
    }

    /// Runs `work` on the stack, which is then as high as before.
    fn on_stack<T>(&self, work: impl FnOnce(Stack<'_>) -> T) -> T {
        let stack = self.stack();
        let base = stack.top();
        let result = work(stack);
        stack.set_top(base.min(stack.top()));
        result
    }
}

impl Interpreter for LuaInterpreter {
    fn start(&self) -> Result<(), ScriptError> {
        Ok(startup::fill(
            &self.sim()?,
            &self.state,
            &self.user_modules,
        )?)
    }

    fn load(&self, source: &SourceText<'_>) -> Result<(), ScriptError> {
        let stack = self.stack();
        stack.load_text(source.text, source.chunk_name)?;
        if let Some(path) = &source.counted_as {
            coverage::begin(stack, source, path);
        }
        debugging::begin(stack, source.text);
        if old_calls::are_expected_by(source.text) {
            Ok(old_calls::begin(stack, &*self.sim()?)?)
        } else {
            Ok(stack.protected_call(0, 0)?)
        }
    }

    fn defines(&self, call: SysCall) -> bool {
        let stack = self.stack();
        let kind = stack.push_global(call.name());
        stack.pop(1);
        kind == Type::Function
    }

    fn call_callback(&self, call: SysCall, args: &[Data]) -> Result<CallbackResult, ScriptError> {
        // This is the hot path: what lies below the function stays there until the end, and from call to call where it can.
        let stack = self.stack();
        let _running = RunningCallback::begin(call as usize);
        if let Some(kind) = self.bottom.push_function(stack, call) {
            let _guard = StackGuard(stack, &self.bottom);
            return run_callback(stack, bottom::HANDLER, kind, || push_args(stack, args));
        }
        self.on_stack(|stack| {
            let handler = stack.push_message_handler();
            let kind = stack.push_global(call.name());
            run_callback(stack, handler, kind, || push_args(stack, args))
        })
    }

    fn call_with_integers(
        &self,
        call: SysCall,
        table: Integers<'_>,
    ) -> Result<CallbackResult, ScriptError> {
        let stack = self.stack();
        let Some(kind) = self.bottom.push_function(stack, call) else {
            return self.call_callback(call, &[table.to_data()]);
        };
        let _running = RunningCallback::begin(call as usize);
        let _guard = StackGuard(stack, &self.bottom);
        run_callback(stack, bottom::HANDLER, kind, || {
            self.bottom.push_integers(stack, table);
            Ok(1)
        })
    }

    fn is_idle(&self, call: SysCall, is_defined: bool) -> bool {
        !is_defined || self.on_stack(|stack| self.idle.is_idle(stack, call))
    }

    fn random_state(&self) -> Option<[u64; 4]> {
        self.state.random_state()
    }

    fn seed_random(&self, seed: u32) -> Result<(), ScriptError> {
        if self.state.set_random_state(startup::random_of(seed)) {
            return Ok(());
        }
        startup::seed_random(self.state.lua(), seed)
            .map_err(|error| ScriptError::new(error.to_string()))
    }

    fn host_calls(&self) -> Option<u64> {
        Some(self.stack().owner().host_calls.get())
    }

    fn call_hook(&self, hook: &Hook, args: &[Data]) -> Result<bool, ScriptError> {
        self.on_stack(|stack| {
            push_hook(stack, hook);
            if stack.kind(-1) != Type::Function {
                return Ok(false);
            }
            stack.protected_call(push_args(stack, args)?, 0)?;
            Ok(true)
        })
    }

    fn call(&self, function: Callee<'_>, args: &[Data]) -> Result<Vec<Data>, CallError> {
        self.on_stack(|stack| {
            let base = stack.top();
            let name_count = match function {
                Callee::Named(name) => push_named(stack, name).ok_or(CallError::NoSuchFunction)?,
                Callee::Function(function) => {
                    stack.push_function(function);
                    0
                }
            };
            let count = push_args(stack, args).map_err(ScriptError::from)?;
            Ok(collect(stack, base, name_count + count).map_err(ScriptError::from)?)
        })
    }

    fn run(&self, text: &[u8], chunk_name: &str) -> Result<(), ScriptError> {
        let stack = self.stack();
        stack.load_text(text, chunk_name)?;
        debugging::begin(stack, text);
        Ok(stack.protected_call(0, 0)?)
    }

    fn evaluate(&self, text: &[u8]) -> Result<Vec<Data>, ScriptError> {
        self.on_stack(|stack| {
            let base = stack.top();
            load_expression_or_chunk(stack, text)?;
            Ok(collect(stack, base, 0)?)
        })
    }

    fn call_library(
        &self,
        module: &str,
        function: &str,
        args: &[Data],
    ) -> Result<Vec<Data>, ScriptError> {
        self.on_stack(|stack| {
            let base = stack.top();
            stack.load_text(CALL, "call")?;
            library_globals::apply(stack, module);
            stack.push_bytes(module.as_bytes());
            stack.push_bytes(function.as_bytes());
            Ok(collect(stack, base, push_args(stack, args)? + 2)?)
        })
    }

    fn release(&self, function: FunctionRef) {
        self.stack().release_function(function);
    }

    fn traceback(&self) -> String {
        self.stack().traceback()
    }

    fn debuggee(&self) -> Option<&dyn Debuggee> {
        debugging::is_installed(self.stack()).then_some(self)
    }

    fn take_line_counts(&self, sim: &Sim) -> LineCounts {
        let coverage = self.state.lua().app_data_ref::<Coverage>();
        coverage
            .map(|coverage| coverage.take(sim, self.stack()))
            .unwrap_or_default()
    }
}

impl From<LuaError> for ScriptError {
    fn from(error: LuaError) -> Self {
        // The original does not log a thread that yields where it cannot.
        let is_silent = YIELD_ERRORS.iter().any(|text| error.text.contains(text));
        Self {
            text: error.text,
            is_silent,
        }
    }
}

/// Calls what is on top, which is of that kind, if it is a function, with the arguments that `push` pushes.
fn run_callback(
    stack: Stack<'_>,
    handler: i32,
    kind: Type,
    push: impl FnOnce() -> Result<i32, LuaError>,
) -> Result<CallbackResult, ScriptError> {
    if kind != Type::Function {
        return Ok(CallbackResult::NotDefined);
    }
    let count = push()?;
    let base = stack.top() - count - 1;
    stack.call_above(handler, count, MULTIPLE)?;
    // Results are made where the caller expects them: to move one right after its parts were written stalls the processor.
    if stack.top() <= base {
        return Ok(CallbackResult::Returned(None));
    }
    Ok(CallbackResult::Returned(Some(data::read_data(stack, -1)?)))
}

/// Lowers the stack to its bottom when a callback has ended.
struct StackGuard<'a>(Stack<'a>, &'a Bottom);

impl Drop for StackGuard<'_> {
    fn drop(&mut self) {
        let Self(stack, bottom) = self;
        if stack.top() > bottom.count() {
            stack.set_top(bottom.count());
        }
    }
}

/// Pushes arguments for a call; returns their number.
fn push_args(stack: Stack<'_>, args: &[Data]) -> Result<i32, LuaError> {
    if !stack.reserve(args.len() + 8) {
        return Err(LuaError {
            text: "stack overflow: too many arguments.".into(),
        });
    }
    args.iter().for_each(|arg| data::push_data(stack, arg));
    Ok(numbers::count_i32(args.len()))
}

fn push_hook(stack: Stack<'_>, hook: &Hook) {
    match hook.function {
        Some(function) => {
            stack.push_function(function);
        }
        None => push_dotted(stack, &hook.name),
    }
}

/// Pushes the global `a.b.c`, walking through plain tables; nil when it is not there.
fn push_dotted(stack: Stack<'_>, name: &str) {
    stack.push_globals();
    for part in name.split('.') {
        if stack.kind(-1) != Type::Table {
            stack.pop(1);
            return stack.push_nil();
        }
        stack.raw_get_field(-1, part);
        stack.remove(-2);
    }
}

/// Pushes the function of that name, or the script's `sysCall_ext` with the name as its first argument; returns the number of arguments
/// pushed. None when there is no such function. The name may end with the language, `@lua`.
fn push_named(stack: Stack<'_>, name: &str) -> Option<i32> {
    let name = name.strip_suffix("@lua").unwrap_or(name);
    if stack.push_global(SysCall::Ext.name()) == Type::Function {
        stack.push_bytes(name.as_bytes());
        return Some(1);
    }
    stack.pop(1);
    push_dotted(stack, name);
    (stack.kind(-1) == Type::Function).then_some(0)
}

/// Calls what is on the stack above `base` and reads its results.
fn collect(stack: Stack<'_>, base: i32, arguments: i32) -> Result<Vec<Data>, LuaError> {
    stack.protected_call(arguments, MULTIPLE)?;
    let results = (base + 1..=stack.top()).map(|index| data::read_data(stack, index));
    results.collect::<Result<_, _>>().map_err(|error| LuaError {
        text: error.to_string(),
    })
}

fn load_expression_or_chunk(stack: Stack<'_>, code: &[u8]) -> Result<(), LuaError> {
    let name = String::from_utf8_lossy(code);
    let expression = [b"return ", code].concat();
    stack
        .load_text(&expression, &name)
        .or_else(|_| stack.load_text(code, &name))
}
