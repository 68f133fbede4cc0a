/** Short names of the documents that the service reads and answers. */
import type { components } from './types.js';

type Schemas = components['schemas'];

export type Model = Schemas['Model'];
export type Analysis = Schemas['Analysis'];
export type RequestDocument = Schemas['Request'];
export type Member = Schemas['Member'];
export type Support = Schemas['Support'];
export type Spring = Schemas['Spring'];
export type Foundation = Schemas['Foundation'];
export type Load = Schemas['Load'];
export type Monitor = Schemas['Monitor'];
export type Location = Schemas['Location'];

export type Result = Schemas['Result'];
export type State = Schemas['State'];
export type MemberState = Schemas['MemberState'];
export type FoundationState = Schemas['FoundationState'];
export type Branch = Schemas['Branch'];
export type CriticalPoint = Schemas['CriticalPoint'];
export type Mode = Schemas['Mode'];
export type Frequencies = Schemas['Frequencies'];
export type Vibration = Schemas['Vibration'];

export type Job = Schemas['Job'];
export type JobList = Schemas['JobList'];
export type Status = Schemas['Status'];
export type Problem = Schemas['Problem'];
export type Finding = Schemas['Finding'];
export type Check = Schemas['Check'];
export type Sweep = Schemas['Sweep'];
export type SweepList = Schemas['SweepList'];
export type SweepDocument = Schemas['SweepDocument'];
export type SweepParameter = Schemas['SweepParameter'];
export type Table = Schemas['Table'];
export type Limits = Schemas['Limits'];
export type Description = Schemas['Description'];
export type JobProgressEvent = Schemas['JobProgressEvent'];
export type PathPointsEvent = Schemas['PathPointsEvent'];
export type CriticalPointEvent = Schemas['CriticalPointEvent'];
export type Warning = Schemas['Warning'];
export type SweepProgressEvent = Schemas['SweepProgressEvent'];
export type Metadata = Schemas['Metadata'];
