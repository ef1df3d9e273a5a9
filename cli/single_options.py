"""Options that take one value are refused where they are typed twice; lists such as --set and --over are not."""

import typer.core


class Command(typer.core.TyperCommand):
    """Command in which no option with one value is typed twice: of two values the last would count, without a word."""

    def parse_args(self, ctx, args):
        if twice := _typed_twice(self.make_parser(ctx).parse_args(args=list(args))[2]):
            ctx.fail(f"{twice} is given twice; give it once")
        return super().parse_args(ctx, args)


def _typed_twice(parameters):
    """Name of an option that occurs twice among the parameters of a command line, "" without one; of flags only those with an
    opposite can contradict themselves.
    """
    single = [one for one in parameters if one.param_type_name == "option" and not one.multiple
              and (one.secondary_opts or not one.is_flag)]
    return next(("/".join((*one.opts, *one.secondary_opts)) for n, one in enumerate(single) if one in single[:n]), "")
