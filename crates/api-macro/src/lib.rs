//! `#[api("sim.name")]`: turns a plain Rust function into a scriptable one.
//!
//! The function stays as written. Next to it, in a module of the same name, the macro puts `API`:
//! its name, documentation, parameters, result type and call glue. Everything else (registration,
//! reference, editor stubs, coverage) reads those rows.

mod doc;
mod parameter;
#[cfg(test)]
mod tests;

use doc::Doc;
use parameter::Parameter;
use proc_macro::TokenStream;
use proc_macro2::TokenStream as Tokens;
use quote::quote;
use syn::parse::{Parse, ParseStream};
use syn::{FnArg, ItemFn, LitStr, PatType, ReturnType, Token, Type, parse_macro_input};

/// See the crate's documentation. Parameters get their name in camel case, or, with `#[api("simZMQ.name", snake_case)]`,
/// as written; `#[name("objectID")]` gives one another name. A leading underscore is no part of the name. Each `@param` of
/// the documentation must name a parameter as scripts see it.
///
/// The first parameter is the context, `&Cx` (reads) or `&mut Cx` (writes, or calls scripts); the others implement
/// `FromScript`; the result is `Result<T>` with `T: IntoScript`. `#[default(expr)]` makes a parameter optional, where its
/// type is not optional of itself (`FromScript::ABSENCE`). The reference shows the value, or, with
/// `#[default(expr, "sim.constant")]`, the constant that has this value.
#[proc_macro_attribute]
pub fn api(name: TokenStream, item: TokenStream) -> TokenStream {
    let attribute = parse_macro_input!(name as Attribute);
    let mut function = parse_macro_input!(item as ItemFn);
    expand(&attribute, &mut function)
        .unwrap_or_else(syn::Error::into_compile_error)
        .into()
}

/// `"sim.name"`, or `"simZMQ.name", snake_case` for a function whose parameters keep their names.
struct Attribute {
    name: LitStr,
    is_snake_case: bool,
}

impl Parse for Attribute {
    fn parse(input: ParseStream<'_>) -> syn::Result<Self> {
        let name = input.parse()?;
        let is_snake_case = input.parse::<Option<Token![,]>>()?.is_some();
        if is_snake_case {
            let word: syn::Ident = input.parse()?;
            if word != "snake_case" {
                return Err(syn::Error::new(word.span(), "expected `snake_case`"));
            }
        }
        Ok(Self {
            name,
            is_snake_case,
        })
    }
}

fn expand(attribute: &Attribute, function: &mut ItemFn) -> syn::Result<Tokens> {
    let output = output_type(function)?;
    let doc = Doc::of(&function.attrs);
    let mut inputs = function.sig.inputs.iter_mut();
    let mutates = takes_mut_context(inputs.next())?;
    let parameters = inputs
        .map(|input| Parameter::take(input, attribute.is_snake_case))
        .collect::<syn::Result<Vec<_>>>()?;
    check_names(&parameters)?;
    doc.check_parameters(
        &parameters
            .iter()
            .map(|parameter| parameter.name.as_str())
            .collect::<Vec<_>>(),
    )?;
    let glue = glue(
        attribute,
        function,
        &doc.text(),
        mutates,
        &parameters,
        &output,
    );
    Ok(quote!(#function #glue))
}

fn check_names(parameters: &[Parameter]) -> syn::Result<()> {
    for (i, parameter) in parameters.iter().enumerate() {
        if parameters[..i]
            .iter()
            .any(|earlier| earlier.name == parameter.name)
        {
            let reason = format!("scripts would know two parameters as `{}`", parameter.name);
            return Err(syn::Error::new(parameter.ident.span(), reason));
        }
    }
    Ok(())
}

/// The module next to the function.
fn glue(
    attribute: &Attribute,
    function: &ItemFn,
    doc: &str,
    mutates: bool,
    parameters: &[Parameter],
    output: &Type,
) -> Tokens {
    let (name, ident) = (&attribute.name, &function.sig.ident);
    let results = result_types(output.clone());
    let rows = parameters.iter().map(Parameter::row);
    let perform = perform(ident, mutates, parameters, output);
    quote! {
        #[allow(non_snake_case, unused_imports, clippy::wildcard_imports)]
        pub(crate) mod #ident {
            use super::*;
            use ::script::{ApiFn, Args, DefaultValue, FromScript, IntoScript, Param, Source, Values};

            pub(crate) const API: ApiFn = ApiFn {
                name: #name,
                doc: #doc,
                params: &[#(#rows),*],
                returns: &[#(<#results as IntoScript>::TYPE),*],
                mutates: #mutates,
                call,
                call_data,
            };

            fn call(args: &mut Args<'_>) -> Result<std::ffi::c_int> {
                let out = perform(args)?;
                args.finish(out)
            }

            fn call_data<'a>(args: &mut Args<'a, Values<'a>>) -> Result<Vec<::scene::Data>> {
                let mut results = Vec::new();
                perform(args)?.into_script(&mut results)?;
                Ok(results)
            }

            #perform
        }
    }
}

/// Decodes the arguments and calls the function.
fn perform(ident: &syn::Ident, mutates: bool, parameters: &[Parameter], output: &Type) -> Tokens {
    let decoders = parameters.iter().map(Parameter::decoder);
    let locals = parameters.iter().map(|parameter| &parameter.ident);
    let context = if mutates {
        quote!(&mut cx)
    } else {
        quote!(&cx)
    };
    quote! {
        #[inline(always)]
        fn perform<'a, S: Source<'a>>(args: &mut Args<'a, S>) -> Result<#output> {
            args.require(const { Param::count_required(API.params) })?;
            #(#decoders)*
            let mut cx = args.context()?;
            let _ = &mut cx;
            super::#ident(#context, #(#locals),*)
        }
    }
}

/// The `T` of `-> Result<T>`.
fn output_type(function: &ItemFn) -> syn::Result<Type> {
    if let ReturnType::Type(_, ty) = &function.sig.output
        && let Type::Path(path) = &**ty
        && let Some(last) = path.path.segments.last()
        && let syn::PathArguments::AngleBracketed(args) = &last.arguments
        && let Some(syn::GenericArgument::Type(ty)) = args.args.first()
    {
        return Ok(ty.clone());
    }
    Err(syn::Error::new_spanned(
        &function.sig,
        "a scriptable function returns `Result<T>`",
    ))
}

/// Several results are a tuple, none is `()`.
fn result_types(output: Type) -> Vec<Type> {
    match output {
        Type::Tuple(tuple) => tuple.elems.into_iter().collect(),
        single => vec![single],
    }
}

fn takes_mut_context(first: Option<&mut FnArg>) -> syn::Result<bool> {
    match first {
        Some(FnArg::Typed(PatType { ty, .. })) => match &**ty {
            Type::Reference(reference) => Ok(reference.mutability.is_some()),
            other => Err(syn::Error::new_spanned(
                other,
                "the first parameter is `&Cx` or `&mut Cx`",
            )),
        },
        _ => Err(syn::Error::new(
            proc_macro2::Span::call_site(),
            "the first parameter is `&Cx` or `&mut Cx`",
        )),
    }
}
