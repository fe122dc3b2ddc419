// Compiled, not run: what a program in TypeScript may write, and what it may not.
import { translate, verify, run, check, dialects, UsageError, Diagnostic } from 'cnctrans';

async function all(): Promise<string[]> {
  const done = await translate({ name: 'part.pim', text: 'M30\n' }, { from: 'fagor', to: 'num', numbering: 'renumber', set: { P1: 2 } });
  const said: Diagnostic[] = done.diagnostics;
  const again = await verify('part.pim', done.outputs, { to: 'num' });
  const events = (await run('part.pim', { events: true })).events ?? [];
  // @ts-expect-error: no such language
  await translate('part.pim', { to: 'basic' });
  // @ts-expect-error: no such option
  await check('part.pim', { to: 'num' });
  return [again.verdict, ...said.map((d) => d.code), ...events.map((e) => e.event), ...(await dialects()).machines, String(UsageError)];
}
void all;
